/* gnathos compare PREDICTED ACTUAL: how far a predicted face lies from the actual one. */
#include "app/cli/compare_print.h"
#include "app/cli/verb.h"
#include "app/planner/predict/compare_record.h"
#include "geometry/mesh_file.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/signed.h"
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct compare_options {
    const char *landmarks, *actual_landmarks, *actual_skull;
    bool no_pictures;
    compare_align align;
    double range_mm;
} compare_options;

enum { KEY_ACTUAL = KEY_OWN, KEY_SKULL, KEY_ALIGN, KEY_NO_ALIGN, KEY_NO_PICTURES, KEY_RANGE };

static const struct argp_option options[] = {
    {"landmarks", 'l', "FILE", 0, "Landmarks of the predicted face, where it is a mesh", 0},
    {"actual-landmarks", KEY_ACTUAL, "FILE", 0, "Landmarks of the actual face, to compare them too", 0},
    {"actual-skull", KEY_SKULL, "FILE", 0, "Skull in the actual face's place, to align the faces on bone", 0},
    {"align", KEY_ALIGN, "HOW", 0,
     "bone: on the front of the cranium (default where both faces have it); skin: on forehead, dorsum of the nose and "
     "sides of the orbits (default else); none: as registered, both faces as they lie",
     0},
    {"no-align", KEY_NO_ALIGN, NULL, 0, "The same as --align none", 0},
    OPTION_OUTPUT("Folder for the tables, the surface with the distances and the picture"),
    OPTION_FORCE,
    {"no-pictures", KEY_NO_PICTURES, NULL, 0, "Leave the picture out", 0},
    {"range", KEY_RANGE, "MM", 0, "End of the colour range, to both sides (5: pictures of different faces compare)", 0},
    {0}};

static compare_align read_align(const char *arg, struct argp_state *state)
{
    static const char *const word[] = {[ALIGN_BONE] = "bone", [ALIGN_SKIN] = "skin", [ALIGN_NONE] = "none"};
    for (int i = ALIGN_BONE; i <= ALIGN_NONE; i++)
        if (!strcmp(arg, word[i])) return (compare_align)i;
    argp_error(state, "--align %s: must be bone, skin or none", arg);
    return ALIGN_USUAL;
}

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    compare_options *o = r->own;
    char *end;
    switch (key) {
    case 'l': o->landmarks = arg; return 0;
    case KEY_ACTUAL: o->actual_landmarks = arg; return 0;
    case KEY_SKULL: o->actual_skull = arg; return 0;
    case KEY_ALIGN: o->align = read_align(arg, state); return 0;
    case KEY_NO_ALIGN: o->align = ALIGN_NONE; return 0;
    case KEY_NO_PICTURES: o->no_pictures = true; return 0;
    case KEY_RANGE:
        o->range_mm = strtod(arg, &end);
        if (end == arg || *end || !(o->range_mm > 0) || o->range_mm > 1000)
            command_usage(state, "--range must lie above 0 and up to 1000 mm, got %s", arg);
        return 0;
    case ARGP_KEY_END:
        if (!r->argument[1]) command_usage(state, "name a predicted and an actual face");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static bool write_table(const face_compare *c, const char *path, err *e)
{
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    fprintf(w.stream, "prediction,region,points,left_out,mean_mm,mean_abs_mm,rms_mm,p90_abs_mm,p95_abs_mm,"
                      "share_under_1_mm,share_under_2_mm\n");
    for (int k = 0; k < c->predictions; k++)
        for (int r = 0; r < ROW_COUNT; r++) {
            const distance_stats *s = &c->row[k][r];
            fprintf(w.stream, "%s,%s,%d,%d", prediction_name((prediction_kind)k), face_row_name(r), s->count,
                    s->left_out);
            const double value[] = {s->mean, s->mean_abs, s->rms, s->p90, s->p95, s->under_1, s->under_2};
            for (size_t i = 0; i < sizeof value / sizeof *value; i++)
                fprintf(w.stream, s->count ? ",%.6g" : ",", value[i]);
            fputc('\n', w.stream);
        }
    return whole_file_close(&w, e);
}

static bool write_pictures(const run_context *r, const face_compare *c, err *e)
{
    const compare_options *o = r->own;
#if GNATHOS_WITH_RENDER
    if (o->no_pictures) return true;
    char *path = output_dir_file(&r->dir, "signed.png"), title[600];
    snprintf(title, sizeof title, "%s against %s", r->argument[1], r->argument[0]);
    command_progress_at(&r->common, "drawing the picture", -1);
    bool ok = signed_picture_write(c, title, o->range_mm, path, e);
    free(path);
    return ok;
#else
    (void)c, (void)e;
    if (!o->no_pictures) command_note(&r->common, "no pictures: this build has no renderer (GNATHOS_RENDER=OFF)");
    return true;
#endif
}

static bool write_folder(run_context *r, const json_t *record, const face_compare *c, err *e)
{
    const output_dir *dir = &r->dir;
    char *comparison = output_dir_file(dir, "comparison.json"), *table = output_dir_file(dir, "regions.csv"),
         *mesh = output_dir_file(dir, "comparison.vtp");
    point_array distance = {"Signed", 1, c->signed_mm[PREDICTED]};
    bool ok = json_file_write(record, comparison, e) && write_table(c, table, e) &&
              mesh_write_surface_arrays(&c->skin[PREDICTED], &distance, 1, mesh, e) && write_pictures(r, c, e);
    free(comparison);
    free(table);
    free(mesh);
    return ok && output_dir_close(&r->dir, e);
}

static void defaults(void *own) { *(compare_options *)own = (compare_options){.range_mm = 5}; }

static bool run(run_context *r, err *e)
{
    const compare_options *o = r->own;
    face_compare c = {0};
    face_compare_input what = {r->argument[0],      r->argument[1],  o->landmarks,
                               o->actual_landmarks, o->actual_skull, o->align};
    command_progress_at(&r->common, "comparing", -1);
    bool ok = face_compare_make(&what, &c, e);
    json_t *record = ok ? face_compare_json(&what, &c) : NULL;
    ok = ok && (!r->out_path || write_folder(r, record, &c, e));
    if (ok && r->common.json)
        command_print_record(json_incref(record));
    else if (ok)
        compare_print(&c);
    json_decref(record);
    face_compare_free(&c);
    return ok;
}

const verb verb_compare = {
    .arguments = "PREDICTED ACTUAL",
    .about =
        "Compares a predicted face (an outcome of gnathos predict, or a mesh) with an actual one (a mesh, or another "
        "outcome): the signed distance of the surfaces by region. An outcome is also held against two trivial "
        "predictions: the skin before, and the skin before moved by 0.85 of the bones' own moves, smoothed over 12 mm.",
    .options = options,
    .argument_count = 2,
    .need = NEED_OUTPUT,
    .own_size = sizeof(compare_options),
    .defaults = defaults,
    .parse = parse,
    .run = run};
