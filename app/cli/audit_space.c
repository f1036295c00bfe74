/* gnathos audit CASE: how far may each bone be moved, and what stops it? */
#include "app/cli/audit.h"
#include "app/cli/bounds_print.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/bounds.h"
#endif
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The number of a control, taken into the settings where it is new. */
static bool take_control(const char *name, const case_file *c, audit_settings *s, int *number, err *e)
{
    control x;
    if (!control_find(name, c, &x, e)) return false;
    for (*number = 0; *number < s->control_count; ++*number)
        if (!strcmp(s->control[*number].name, name)) return true;
    if (s->control_count == SAMPLE_AXES_MAX) return err_set(e, ERR_USAGE, "more than %d controls", SAMPLE_AXES_MAX);
    s->control[s->control_count++] = x;
    return true;
}

static void add_request(audit_settings *s, const audit_request *r)
{
    for (int i = 0; i < s->request_count; i++)
        if (!memcmp(&s->request[i], r, sizeof *r)) return;
    s->request[s->request_count++] = *r;
}

static bool take_word(const char *word, int axes, const case_file *c, audit_settings *s, err *e)
{
    static const char *const option[] = {"--line", "--pair", "--box"};
    static const char *const wanted[] = {"one control", "two controls with a comma between them",
                                         "three controls with commas between them"};
    char *copy = mem_text(word), *rest = NULL;
    audit_request r = {0};
    bool ok = true;
    for (char *name = strtok_r(copy, ",", &rest); ok && name; name = strtok_r(NULL, ",", &rest)) {
        int k;
        ok = r.axis_count < axes ||
             err_set(e, ERR_USAGE, "%s %s: must name %s", option[axes - 1], word, wanted[axes - 1]);
        ok = ok && take_control(name, c, s, &k, e);
        for (int i = 0; ok && i < r.axis_count; i++)
            if (r.axis[i] == k) ok = err_set(e, ERR_USAGE, "%s %s: names %s twice", option[axes - 1], word, name);
        if (ok) r.axis[r.axis_count++] = k;
    }
    if (ok && r.axis_count < axes)
        ok = err_set(e, ERR_USAGE, "%s %s: must name %s", option[axes - 1], word, wanted[axes - 1]);
    free(copy);
    for (int k = 0; ok && k < axes; k++) add_request(s, &(audit_request){1, {r.axis[k]}});
    if (ok) add_request(s, &r);
    return ok;
}

/* A map is of use by default: of two sides of the box, or of a bone and what rides on it. */
static bool make_a_pair(const control *a, const control *b)
{
    bool rides = a->segment == SEGMENT_DISTAL && b->segment == SEGMENT_CHIN && a->axis == b->axis;
    return rides || (a->audit == CONTROL_AUDIT_BOX && b->audit == CONTROL_AUDIT_BOX);
}

/* What the table of controls asks for, as far as the case cuts the bones free. */
static bool take_default(const case_file *c, audit_settings *s, err *e)
{
    audit_request box = {0};
    int sides = 0;
    for (int i = 0; i < CONTROL_COUNT; i++) {
        int k;
        const control *x = &controls[i];
        sides += x->audit == CONTROL_AUDIT_BOX;
        if (x->audit == CONTROL_AUDIT_NONE || !case_file_frees(c, x->segment)) continue;
        if (!take_control(x->name, c, s, &k, e)) return false;
        add_request(s, &(audit_request){1, {k}});
        if (x->audit == CONTROL_AUDIT_BOX) box.axis[box.axis_count++] = k;
    }
    for (int a = 0; a < s->control_count; a++)
        for (int b = a + 1; b < s->control_count; b++)
            if (make_a_pair(&s->control[a], &s->control[b])) add_request(s, &(audit_request){2, {a, b}});
    if (box.axis_count == sides) add_request(s, &box);
    return s->request_count > 0 || err_at(e, ERR_INPUT, c->path, 0, NULL, "cuts no bone, so that nothing can be moved");
}

static void show_points(int64_t done, int64_t expected, double left_s, void *context)
{
    char stage[96];
    snprintf(stage, sizeof stage,
             left_s < 90 ? "judging bones: %lld points, %.0f s left" : "judging bones: %lld points, %.0f min left",
             (long long)done, left_s < 90 ? left_s : left_s / 60);
    command_progress_at(context, stage, (double)done / (double)expected);
}

static void show_solves(int round, int done, int count, void *context)
{
    char stage[96];
    snprintf(stage, sizeof stage, "solving soft tissue: round %d, %d of %d points", round, done, count);
    command_progress_at(context, stage, -1);
}

static bool settings_of(const run_context *r, audit_settings *out, err *e)
{
    const audit_options *o = r->own;
    audit_settings s = {.spacing = o->spacing, .tolerance = o->tolerance, .tissue = !o->geometry_only};
    for (int i = 0; i < o->word_count; i++)
        if (!take_word(o->word[i], o->axis_count[i], &r->patient, &s, e)) return false;
    if (!o->word_count && !take_default(&r->patient, &s, e)) return false;
    *out = s;
    return true;
}

bool audit_space_early(run_context *r, err *e)
{
    audit_settings s;
    return settings_of(r, &s, e);
}

static bool write_all(const run_context *r, const audit *a, err *e)
{
    output_dir dir = {0};
    if (!output_dir_open(r->out_path, r->force, &dir, e)) return false;
    bool ok = audit_write_files(a, &dir, e);
#if GNATHOS_WITH_RENDER
    const audit_options *o = r->own;
    if (ok && !o->no_pictures) ok = audit_write_pictures(a, &dir, e);
#endif
    if (ok && command_interrupted()) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    ok = ok && output_dir_close(&dir, e);
    output_dir_abandon(&dir);
    return ok;
}

/* "DIR.journal" in a new string. */
static char *journal_path(const char *folder)
{
    size_t size = strlen(folder) + 16;
    char *path = NEW_ARRAY(char, size);
    snprintf(path, size, "%s", folder);
    for (size_t n = strlen(path); n > 1 && path[n - 1] == '/'; n--) path[n - 1] = 0;
    strcat(path, ".journal");
    return path;
}

static bool judge_all(const run_context *r, audit *a, err *e)
{
    char key[HASH_TEXT_SIZE], *path = journal_path(r->out_path);
    journal j;
    audit_key(a, key);
    bool ok = journal_open(path, key, r->force, audit_read_record, a, &j, e);
    if (ok) {
        if (j.record_count)
            command_note(&r->common, "%s: goes on after %lld finished points and solves", path,
                         (long long)j.record_count);
        a->progress = show_points;
        a->solved = show_solves;
        a->interrupted = r->watch.interrupted;
        a->context = r->watch.context;
        ok = audit_bones(a, &j, e) && (!a->settings.tissue || audit_tissue(a, &j, e));
        sample_set_sort(&a->points);
        tissue_set_sort(&a->tissue);
        ok = ok && write_all(r, a, e);
        if (ok)
            journal_remove(&j);
        else if (e->code == ERR_INTERRUPTED)
            command_note(&r->common, "%s keeps %lld finished points and solves; the same command goes on from there",
                         path, (long long)j.record_count);
        journal_close(&j);
    }
    free(path);
    return ok;
}

static bool print(const run_context *r, const audit *a, err *e)
{
    if (!r->common.json) {
        if (!bounds_print(a, e)) return false;
        printf("Results in %s\n", command_shown(r->out_path));
        return true;
    }
    json_t *record;
    if (!audit_json(a, &record, e)) return false;
    command_print_record(record);
    return true;
}

bool audit_space_run(run_context *r, err *e)
{
    audit_settings settings;
    audit a = {0};
    output_dir_abandon(&r->dir); /* it can be written; until there is a result, the journal alone is kept */
    bool ok = settings_of(r, &settings, e) &&
              audit_make(&r->patient, &r->prepared, r->plan_path ? &r->plan : NULL, &settings, &a, e) &&
              judge_all(r, &a, e) && print(r, &a, e);
    audit_free(&a);
    return ok;
}
