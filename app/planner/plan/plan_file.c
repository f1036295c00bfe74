#include "app/planner/plan/plan_file.h"
#include "geometry/suggest.h"
#include "geometry/transform_file.h"
#include <string.h>

enum { PLACE_SIZE = 128 };

plan_file plan_file_default(void)
{
    plan_file p = {.version = 1, .load_steps = 4};
    for (int i = 0; i < CONTROL_COUNT; i++) p.value[i] = controls[i].usual;
    return p;
}

static const char *cut_for(segment_id s)
{
    return s == SEGMENT_MAXILLA ? "le_fort_1" : s == SEGMENT_CHIN ? "genioplasty" : "bsso";
}

/* A move of a piece that no cut frees is refused. */
static void check_freed(const json_file *f, const case_file *c, segment_id s, const char *place, issue_list *issues)
{
    if (case_file_frees(c, s)) return;
    fields_issue(f, place, issues, "moves the %s segment, which %s does not cut; add \"%s\" to its osteotomies",
                 segment_name(s), c->path, cut_for(s));
}

static void read_pivot(const json_file *f, const json_t *v, const char *place, plan_segment *s, issue_list *issues)
{
    err e = {0};
    const char *label = json_string_value(v);
    if (json_is_array(v) && json_file_vec3(f, v, place, s->move.pivot_mm, &e))
        s->has_pivot_point = true;
    else if (label && *label && strlen(label) < LANDMARK_LABEL_SIZE)
        strcpy(s->pivot, label);
    else
        fields_issue(f, place, issues, "must be the label of a landmark, or three numbers [x, y, z] in mm");
}

static void read_matrix(const json_file *f, const json_t *v, const char *place, plan_segment *s, issue_list *issues)
{
    err e = {0};
    double m[16];
    char got[96];
    if (!json_is_array(v) || json_array_size(v) != 16) {
        fields_issue(f, place, issues, "is %s; must be a list of 16 numbers, row by row",
                     fields_value_words(v, got, sizeof got));
        return;
    }
    for (size_t i = 0; i < 16; i++) {
        const json_t *one = json_array_get(v, i);
        if (!json_is_number(one)) {
            fields_issue(f, place, issues, "number %zu is %s; must be a list of 16 numbers", i + 1,
                         fields_value_words(one, got, sizeof got));
            return;
        }
        m[i] = json_number_value(one);
    }
    if (!rigid_from_matrix(m, &s->move.motion, &e)) fields_issue(f, place, issues, "%s", e.text);
}

static void read_segment(const json_file *f, const json_t *o, segment_id id, plan_segment *s, issue_list *issues)
{
    char place[PLACE_SIZE], at[64];
    const char *const single[] = {"matrix", "file"};
    err e = {0};
    snprintf(at, sizeof at, "/segments/%s", segment_name(id));
    if (!json_is_object(o)) {
        fields_issue(f, at, issues, "must be an object { ... }");
        return;
    }
    s->line = json_file_line(f, at);
    fields_read(plan_segment_fields(), f, o, at, s, issues);
    const json_t *pivot = json_object_get(o, "pivot");
    s->move.kind = MOVE_ANGLES;
    for (int i = 0; i < 2; i++) {
        if (!json_object_get(o, single[i])) continue;
        s->move.kind = MOVE_RIGID;
        snprintf(place, sizeof place, "%s/%s", at, single[i]);
        const char *key;
        json_t *value;
        json_object_foreach((json_t *)o, key, value)
        {
            if (!strcmp(key, single[i]) || !strncmp(key, "//", 2)) continue;
            fields_issue(f, place, issues, "stands beside \"%s\"; a %s is the whole move of its segment", key,
                         single[i]);
            return;
        }
    }
    if (pivot) {
        snprintf(place, sizeof place, "%s/pivot", at);
        read_pivot(f, pivot, place, s, issues);
    }
    snprintf(place, sizeof place, "%s/matrix", at);
    if (json_object_get(o, "matrix")) read_matrix(f, json_object_get(o, "matrix"), place, s, issues);
    snprintf(place, sizeof place, "%s/file", at);
    if (*s->file && !transform_read(s->file, &s->move.motion, &e)) fields_issue(f, place, issues, "%s", e.text);
}

static void read_segments(const json_file *f, const case_file *c, plan_file *p, issue_list *issues)
{
    const json_t *o = json_object_get(f->root, "segments");
    const char *key, *names[SEGMENT_COUNT];
    json_t *value;
    char place[PLACE_SIZE];
    for (int i = 0; i < SEGMENT_COUNT; i++) names[i] = segment_name((segment_id)i);
    if (!o) return;
    if (!json_is_object(o)) {
        fields_issue(f, "/segments", issues, "must be an object { \"maxilla\": { ... } }");
        return;
    }
    json_object_foreach((json_t *)o, key, value)
    {
        if (!strncmp(key, "//", 2)) continue;
        int id = segment_from_name(key), piece = control_piece_named(key),
            near = suggest_nearest(key, names + 1, SEGMENT_COUNT - 1);
        snprintf(place, sizeof place, "/segments/%.60s", key);
        if (id == SEGMENT_CRANIUM)
            fields_issue(f, place, issues, "the cranium never moves");
        else if (id < 0 && piece >= 0)
            fields_issue(f, place, issues, "unknown segment; did you mean \"%s\"?", segment_name((segment_id)piece));
        else if (id < 0 && near >= 0)
            fields_issue(f, place, issues, "unknown segment; did you mean \"%s\"?", names[near + 1]);
        else if (id < 0)
            fields_issue(f, place, issues,
                         "unknown segment; known are maxilla, distal, proximal_left, proximal_right, chin");
        else {
            for (int i = 0; i < CONTROL_COUNT; i++)
                if (controls[i].kind == CONTROL_OF_SEGMENT && (int)controls[i].segment == id &&
                    json_object_get(f->root, controls[i].name))
                    fields_issue(f, place, issues, "the %s segment is moved by %s too; use one of the two", key,
                                 controls[i].name);
            check_freed(f, c, (segment_id)id, place, issues);
            read_segment(f, value, (segment_id)id, &p->segment[id], issues);
        }
    }
}

static void read_short(const json_file *f, const case_file *c, plan_file *p, issue_list *issues)
{
    for (int i = 0; i < CONTROL_COUNT; i++) {
        const control *x = &controls[i];
        char place[PLACE_SIZE];
        snprintf(place, sizeof place, "/%.60s", x->name);
        if (x->kind != CONTROL_OF_SEGMENT || !json_object_get(f->root, x->name)) continue;
        plan_segment *s = &p->segment[x->segment];
        if (!s->line) s->line = json_file_line(f, place);
        s->short_form = true;
        if (p->value[i] != 0) check_freed(f, c, x->segment, place, issues);
    }
}

static void read_expressions(const json_file *f, plan_file *p, issue_list *issues)
{
    enum { FIRST = CONTROL_EXPRESSION_0, COUNT = CONTROL_REST - FIRST };
    const json_t *list = json_object_get(f->root, "expressions");
    if (!list) return;
    if (!json_is_array(list) || json_array_size(list) != COUNT) {
        fields_issue(f, "/expressions", issues, "must be a list of six numbers from 0 to 1");
        return;
    }
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *v = json_array_get(list, i);
        const control *x = &controls[FIRST + i];
        char place[PLACE_SIZE], got[96];
        snprintf(place, sizeof place, "/expressions/%zu", i);
        if (json_is_number(v) && json_number_value(v) >= x->low && json_number_value(v) <= x->high)
            p->value[FIRST + i] = json_number_value(v);
        else
            fields_issue(f, place, issues, "is %s; must be a number from %g to %g",
                         fields_value_words(v, got, sizeof got), x->low, x->high);
    }
}

static void refuse_unbuilt(const json_file *f, const plan_file *p, issue_list *issues)
{
    for (int i = 0; i < CONTROL_COUNT; i++) {
        const control *x = &controls[i];
        char place[PLACE_SIZE];
        if (x->built || p->value[i] == x->usual) continue;
        int n = snprintf(place, sizeof place, "/%.60s", x->name); /* "jaw.yaw_deg", "expressions[1]" */
        if (place[n - 1] == ']') place[n - 1] = 0;
        for (char *at = place; (at = strpbrk(at, ".["));) *at = '/';
        fields_issue(f, place, issues, "is %g; this control is not built yet, it must stay %g", p->value[i], x->usual);
    }
}

bool plan_file_read(const char *path, const case_file *c, plan_file *out, issue_list *issues)
{
    plan_file p = plan_file_default();
    json_file f = {0};
    err e = {0};
    int errors = issue_count(issues, ISSUE_ERROR), from = issues->count;
    if (strlen(path) >= FIELD_PATH_SIZE) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, NULL, 0, NULL, "the path of the plan has more than %d bytes",
                  FIELD_PATH_SIZE - 1);
        return false;
    }
    strcpy(p.path, path);
    if (!json_file_read(path, &f, &e)) {
        issue_add_err(issues, ISSUE_ERROR, &e, path);
        return false;
    }
    if (!json_is_object(f.root)) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, path, 1, NULL, "must be an object { ... }");
    } else if (json_object_get(f.root, "surfaces")) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, path, 1, NULL, "is a case, not a plan; a plan names moves of bones");
    } else {
        fields_read(plan_fields(), &f, f.root, "", &p, issues);
        read_short(&f, c, &p, issues);
        read_segments(&f, c, &p, issues);
        read_expressions(&f, &p, issues);
        refuse_unbuilt(&f, &p, issues);
        const json_t *why = json_object_get(f.root, "override");
        if (json_is_string(why) && strspn(json_string_value(why), " \t") == json_string_length(why))
            fields_issue(&f, "/override", issues, "is empty; it must say why a limit may be exceeded");
        issue_sort_by_line(issues, from);
        if (!*p.name) {
            const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
            snprintf(p.name, sizeof p.name, "%.*s", dot && dot > base ? (int)(dot - base) : 200, base);
        }
    }
    json_file_free(&f);
    if (issue_count(issues, ISSUE_ERROR) > errors) return false;
    *out = p;
    return true;
}
