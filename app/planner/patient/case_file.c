#include "app/planner/patient/case_guess.h"
#include "geometry/mem.h"
#include "geometry/suggest.h"
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const cut_names[] = {"le_fort_1", "bsso", "genioplasty"};
static const char *const surface_names[] = {"skin", "skull", "mandible", "upper_teeth", "lower_teeth"};

const char *case_surface_name(case_surface s) { return surface_names[s]; }

mesh_space case_file_space(const case_file *c) { return c->frame == CASE_RAS ? MESH_SPACE_RAS : MESH_SPACE_LPS; }

case_file case_file_default(void)
{
    case_file c = {
        .version = 1,
        .osteotomy_count = 3,
        .osteotomy = {{.cut = CUT_LE_FORT_1}, {.cut = CUT_BSSO}, {.cut = CUT_GENIOPLASTY}},
        .cuts = osteotomy_params_default(),
        .tissue = tissue_params_default(),
        .material = {.young_kpa = 15, .poisson = 0.45},
    };
    for (int i = 0; i < LIMIT_COUNT; i++) c.limits[i] = limit_default[i].range;
    return c;
}

bool case_file_cuts(const case_file *c, case_cut cut)
{
    for (int i = 0; i < c->osteotomy_count; i++)
        if (c->osteotomy[i].cut == cut) return true;
    return false;
}

bool case_file_frees(const case_file *c, segment_id segment)
{
    for (int i = 0; i < c->osteotomy_count; i++)
        if (c->osteotomy[i].cut == CUT_USER &&
            (c->osteotomy[i].segment == segment ||
             (segment == SEGMENT_DISTAL &&
              (c->osteotomy[i].segment == SEGMENT_PROXIMAL_LEFT || c->osteotomy[i].segment == SEGMENT_PROXIMAL_RIGHT))))
            return true;
    switch (segment) {
    case SEGMENT_MAXILLA: return case_file_cuts(c, CUT_LE_FORT_1);
    case SEGMENT_DISTAL:
    case SEGMENT_PROXIMAL_LEFT:
    case SEGMENT_PROXIMAL_RIGHT: return case_file_cuts(c, CUT_BSSO);
    case SEGMENT_CHIN: return case_file_cuts(c, CUT_GENIOPLASTY);
    default: return false;
    }
}

/* One of the object's texts, copied; an issue and false if it is missing or wrong. */
static bool read_text(const json_file *f, const json_t *o, const char *pointer, const char *key, char *out, size_t size,
                      issue_list *issues)
{
    char place[128];
    snprintf(place, sizeof place, "%s/%s", pointer, key);
    const char *text = json_string_value(json_object_get(o, key));
    if (text && *text && strlen(text) < size) {
        strcpy(out, text);
        return true;
    }
    fields_issue(f, place, issues, "must be a text of 1 to %zu bytes", size - 1);
    return false;
}

/* { "segment": "maxilla", "plane": "my Le Fort" } */
static bool read_user_cut(const json_file *f, const json_t *o, const char *pointer, const case_file *c,
                          case_osteotomy *out, issue_list *issues)
{
    static const char *const known[] = {"segment", "plane"};
    char place[128], segment[64];
    const char *key;
    json_t *value;
    bool ok = true;
    json_object_foreach((json_t *)o, key, value)
    {
        if (!strncmp(key, "//", 2) || !strcmp(key, known[0]) || !strcmp(key, known[1])) continue;
        int near = suggest_nearest(key, known, 2);
        snprintf(place, sizeof place, "%s/%.40s", pointer, key);
        if (near >= 0)
            fields_issue(f, place, issues, "unknown field; did you mean \"%s\"?", known[near]);
        else
            fields_issue(f, place, issues, "unknown field; known here: segment, plane");
        ok = false;
    }
    case_osteotomy one = {.cut = CUT_USER};
    ok &= read_text(f, o, pointer, "plane", one.plane, sizeof one.plane, issues);
    if (read_text(f, o, pointer, "segment", segment, sizeof segment, issues)) {
        int id = segment_from_name(segment);
        if (id <= SEGMENT_CRANIUM || id == SEGMENT_DISTAL) {
            snprintf(place, sizeof place, "%s/segment", pointer);
            fields_issue(f, place, issues, "is \"%s\"; must be one of: maxilla proximal_left proximal_right chin",
                         segment);
            ok = false;
        } else {
            one.segment = (segment_id)id;
        }
    } else {
        ok = false;
    }
    if (ok && !*c->planes) {
        snprintf(place, sizeof place, "%s/plane", pointer);
        fields_issue(f, place, issues, "needs a file of planes; name it in \"planes\"");
        ok = false;
    }
    *out = one;
    return ok;
}

static void read_osteotomies(const json_file *f, case_file *c, issue_list *issues)
{
    const json_t *list = json_object_get(f->root, "osteotomies");
    char got[96], place[64];
    if (!list) return;
    if (!json_is_array(list)) {
        fields_issue(f, "/osteotomies", issues, "is %s; must be a list such as [\"le_fort_1\", \"bsso\"]",
                     fields_value_words(list, got, sizeof got));
        return;
    }
    if (json_array_size(list) > CASE_OSTEOTOMIES_MAX) {
        fields_issue(f, "/osteotomies", issues, "lists %zu cuts; at most %d are known", json_array_size(list),
                     CASE_OSTEOTOMIES_MAX);
        return;
    }
    c->osteotomy_count = 0;
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *v = json_array_get(list, i);
        const char *word = json_string_value(v);
        case_osteotomy one = {0};
        snprintf(place, sizeof place, "/osteotomies/%zu", i);
        bool ok = false;
        if (json_is_object(v)) {
            ok = read_user_cut(f, v, place, c, &one, issues);
        } else {
            int id = -1;
            for (int k = 0; word && k < 3; k++)
                if (!strcmp(word, cut_names[k])) id = k;
            ok = id >= 0;
            one.cut = ok ? (case_cut)id : CUT_USER;
            int near = word ? suggest_nearest(word, cut_names, 3) : -1;
            if (ok && case_file_cuts(c, one.cut)) {
                fields_issue(f, place, issues, "%s is listed twice", word);
                ok = false;
            } else if (!ok && near >= 0) {
                fields_issue(f, place, issues, "unknown cut \"%s\"; did you mean \"%s\"?", word, cut_names[near]);
            } else if (!ok) {
                fields_issue(f, place, issues, "unknown cut %s; known are: le_fort_1 bsso genioplasty, or an object",
                             fields_value_words(v, got, sizeof got));
            }
        }
        if (ok) c->osteotomy[c->osteotomy_count++] = one;
    }
}

/* The last part of the folder's real name: for a case without a name. */
static void name_after_folder(case_file *c)
{
    char real[PATH_MAX];
    const char *slash = realpath(c->folder, real) ? strrchr(real, '/') : NULL;
    snprintf(c->name, sizeof c->name, "%.200s", slash && slash[1] ? slash + 1 : "case");
    err_printable(c->name, sizeof c->name);
}

static bool set_paths(const char *path, case_file *c)
{
    struct stat info;
    bool folder = !stat(path, &info) && S_ISDIR(info.st_mode);
    int length = (int)strlen(path);
    while (folder && length > 1 && path[length - 1] == '/') length--;
    bool here = folder && length == 1 && path[0] == '.';
    int n = snprintf(c->path, sizeof c->path, "%.*s%s", here ? 0 : length, path,
                     here     ? "case.json"
                     : folder ? "/case.json"
                              : "");
    const char *slash = strrchr(c->path, '/');
    if (n < 0 || n >= FIELD_PATH_SIZE) return false;
    if (slash)
        snprintf(c->folder, sizeof c->folder, "%.*s", slash == c->path ? 1 : (int)(slash - c->path), c->path);
    else
        strcpy(c->folder, ".");
    return true;
}

/* The limits of moves have the names of what a plan says. */
static bool names_a_move(const json_t *o)
{
    bool any = json_object_get(o, "segments");
    for (int i = 0; i < LIMIT_MOVE_COUNT; i++) any |= json_object_get(o, limit_default[i].name) != NULL;
    return any;
}

/* False where landmarks are not named, or their file is not there, which is no fault of a case that needs none. What is
 * too long for a path is left to fields_read. */
static bool has_landmarks(const json_file *f, const case_file *c)
{
    const json_t *named = json_object_get(f->root, "landmarks");
    const char *name = json_string_value(named);
    char path[2 * FIELD_PATH_SIZE];
    int n = name ? snprintf(path, sizeof path, "%s/%s", *name == '/' ? "" : c->folder, name) : 0;
    return named && !(n > 0 && n < FIELD_PATH_SIZE && *name && access(path, F_OK) && errno == ENOENT);
}

static void ask_for_landmarks(const json_file *f, const char *name, issue_list *issues)
{
    static const char hint[] = "`gnathos landmarks` places them on the surfaces";
    if (name)
        fields_issue(f, "/landmarks", issues, "does not exist; %s: %s", hint, name);
    else
        fields_issue(f, "/landmarks", issues, "is missing; must be the name of a file; %s", hint);
}

/* What two fields must be to each other. */
static void check_lengths(const json_file *f, const tissue_params *t, issue_list *issues)
{
    const json_t *own = json_object_get(f->root, "tissue");
    if (t->element_mm > t->coarse_mm)
        fields_issue(f, json_object_get(own, "element_mm") ? "/tissue/element_mm" : "/tissue/coarse_mm", issues,
                     "element_mm is %g and coarse_mm %g; the finest edge must be at most the coarsest", t->element_mm,
                     t->coarse_mm);
    if (t->detail_mm >= t->hole_mm)
        fields_issue(
            f, json_object_get(own, "hole_mm") ? "/tissue/hole_mm" : "/tissue/detail_mm", issues,
            "hole_mm is %g and detail_mm %g; openings that are spanned must be wider than gaps that are filled",
            t->hole_mm, t->detail_mm);
}

enum { NEEDS_LANDMARKS = 1, NEEDS_BONES = 2, NEEDS_ALL = NEEDS_LANDMARKS | NEEDS_BONES };

static void read_fields(const json_file *f, unsigned needs, case_file *c, issue_list *issues)
{
    field_table t = *case_fields();
    field *row = COPY_ARRAY(field, t.row, t.count);
    for (int i = 0; !(needs & NEEDS_BONES) && i < t.count; i++)
        if (row[i].kind == FIELD_FILE && (row[i].offset == offsetof(case_file, surface[CASE_SKULL]) ||
                                          row[i].offset == offsetof(case_file, surface[CASE_MANDIBLE])))
            row[i].required = false;
    t.row = row;
    fields_read(&t, f, f->root, "", c, issues);
    free(row);
}

static bool read_case(const char *path, unsigned needs, case_file *out, issue_list *issues)
{
    case_file *c = out;
    json_file f = {0};
    err e = {0};
    int errors = issue_count(issues, ISSUE_ERROR), from = issues->count;
    *c = case_file_default();
    if (!set_paths(path, c)) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, NULL, 0, NULL, "the path of the case has more than %d bytes",
                  FIELD_PATH_SIZE - 1);
        return false;
    }
    if (!json_file_read(c->path, &f, &e)) {
        issue_add_err(issues, ISSUE_ERROR, &e, c->path);
        return false;
    }
    if (!json_is_object(f.root)) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->path, 1, NULL, "must be an object { ... }");
    } else if (!json_object_get(f.root, "surfaces") && json_object_get(f.root, "gnathos") && names_a_move(f.root)) {
        issue_add(issues, ISSUE_ERROR, ERR_INPUT, c->path, 1, NULL, "is a plan, not a case; a case names its surfaces");
    } else {
        char *name = NULL;
        bool there = has_landmarks(&f, c);
        if (!there && json_object_get(f.root, "landmarks"))
            name = mem_text(json_string_value(json_object_get(f.root, "landmarks")));
        if (!there) json_object_del(f.root, "landmarks");
        read_fields(&f, needs, c, issues);
        if (!there && (needs & NEEDS_LANDMARKS)) ask_for_landmarks(&f, name, issues);
        free(name);
        check_lengths(&f, &c->tissue, issues);
        read_osteotomies(&f, c, issues);
        case_guess_read(&f, &c->guessed, issues);
        issue_sort_by_line(issues, from);
        const json_t *limits = json_object_get(f.root, "limits");
        for (int i = 0; i < LIMIT_COUNT; i++)
            c->limit_from_case[i] = json_object_get(json_object_get(limits, limit_default[i].name), "stop");
        if (!*c->name) name_after_folder(c);
    }
    json_file_free(&f);
    return issue_count(issues, ISSUE_ERROR) == errors;
}

bool case_file_read(const char *path, case_file *out, issue_list *issues)
{
    return read_case(path, NEEDS_ALL, out, issues);
}

static bool load(const char *path, unsigned needs, case_file *out, err *e)
{
    issue_list issues = {0};
    case_file c;
    bool read = read_case(path, needs, &c, &issues), ok = issue_none_is_error(&issues, e) && read;
    if (ok) *out = c;
    issue_list_free(&issues);
    return ok;
}

bool case_file_load(const char *path, case_file *out, err *e) { return load(path, NEEDS_ALL, out, e); }

bool case_file_load_bare(const char *path, case_file *out, err *e) { return load(path, NEEDS_BONES, out, e); }

bool case_file_load_skin(const char *path, case_file *out, err *e) { return load(path, 0, out, e); }
