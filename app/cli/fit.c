/* gnathos fit CASE -o DIR: the template of heads in the shape of a patient. */
#include "app/cli/fit_write.h"
#include "app/cli/verb.h"
#include "app/planner/identity/template_get.h"
#include "geometry/clock.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/fit.h"
#endif
#include <stdio.h>
#include <stdlib.h>

typedef struct fit_options {
    bool no_landmarks, no_pictures;
} fit_options;

enum { KEY_NO_LANDMARKS = KEY_OWN, KEY_NO_PICTURES };

static const double range_mm = 2; /* end of the colours: beyond the 1.5 mm that 95 % of a good fit lie within */

static const double told_share = 0.05; /* of a part that is guessed: more is warned of */

static const struct argp_option options[] = {OPTION_OUTPUT("The folder of results, which must not exist yet"),
                                             OPTION_FORCE,
                                             {"no-landmarks", KEY_NO_LANDMARKS, NULL, 0,
                                              "Find the place by the surfaces alone, though the case has landmarks", 0},
                                             {"no-pictures", KEY_NO_PICTURES, NULL, 0, "Leave the pictures out", 0},
                                             {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    fit_options *o = r->own;
    (void)arg, (void)state;
    switch (key) {
    case KEY_NO_LANDMARKS: o->no_landmarks = true; return 0;
    case KEY_NO_PICTURES: o->no_pictures = true; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static bool fit(run_context *r, const head_template *t, head_scan *s, head_fit *out, char told[256], err *e)
{
    const fit_options *o = r->own;
    head_fit_params p = head_fit_params_default();
    head_place place;
    double start = clock_s();
    if (!head_scan_read(&r->patient, !o->no_landmarks, s, e)) return false;
    task_progress(&r->watch, "place", 0);
    if (!head_place_find(t, s, &r->watch, &place, told, e)) return false;
    double placed_s = clock_s() - start;
    if (*told) command_note(&r->common, "%s", told);
    if (!head_fit_from(t, s, &p, &place, &r->watch, out, e)) return false;
    out->place_s = placed_s;
    out->total_s += placed_s;
    return true;
}

static bool write_pictures(const run_context *r, const fit_record *of, err *e)
{
    const fit_options *o = r->own;
#if GNATHOS_WITH_RENDER
    if (o->no_pictures) return true;
    static const char *const name[] = {"residual_skin.png", "residual_bones.png", "beside.png"};
    const fit_pictures p = {of->head, of->fit, of->scan, r->patient.name};
    bool ok = true;
    command_progress_at(&r->common, "drawing", -1);
    for (int i = 0; ok && i < 3; i++) {
        char *path = output_dir_file(&r->dir, name[i]);
        ok = i < 2 ? fit_residual_write(&p, i, range_mm, path, e) : fit_beside_write(&p, path, e);
        free(path);
    }
    return ok;
#else
    (void)of, (void)e;
    if (!o->no_pictures) command_note(&r->common, "no pictures: this build has no renderer (GNATHOS_RENDER=OFF)");
    return true;
#endif
}

static bool write_all(run_context *r, const fit_record *of, const json_t *record, err *e)
{
    char *path = output_dir_file(&r->dir, "fit.json");
    bool ok = fit_write_files(of, r->patient.name, range_mm, &r->dir, e) && json_file_write(record, path, e) &&
              write_pictures(r, of, e) && output_dir_close(&r->dir, e);
    free(path);
    return ok;
}

static void warn(const run_context *r, const fit_record *of)
{
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        double share = fit_guessed_share(of->fit, (case_surface)p);
        if (share > told_share)
            command_note(&r->common, "%s: warning: %.0f %% of it is guessed from the template: the scan has %s",
                         case_surface_name((case_surface)p), 100 * share,
                         of->scan->part[p].triangle_count ? "nothing there" : "no such surface");
    }
}

static void print_plain(const run_context *r, const fit_record *of)
{
    const head_fit *f = of->fit;
    printf("%s: placed by %s, turned by %.1f deg, size %.3f of the template's\n", r->patient.name,
           f->place.by_landmarks ? "landmarks" : "its surfaces", rigid_angle(&f->place.motion) * 180 / 3.14159265358979,
           f->place.scale);
    printf("%-14s %9s %9s %9s %9s %9s\n", "distance, mm", "mean", "95 %", "largest", "vertices", "guessed");
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        const registration_gaps *g = &f->gaps[p];
        printf("%-14s ", case_surface_name((case_surface)p));
        if (g->with_target)
            printf("%9.2f %9.2f %9.2f", g->mean_mm, g->p95_mm, g->max_mm);
        else
            printf("%9s %9s %9s", "-", "-", "-");
        printf(" %9d %7.1f %%\n", g->vertices, 100 * fit_guessed_share(f, (case_surface)p));
    }
    printf("guessed: where the scan has no surface the shape is the template's, bent along\n");
    printf("tissue: smallest J %.3f, %d tets inside out; %.1f s (place %.1f, bones %.1f, tissue %.1f)\n", f->min_j,
           f->inverted_tets, f->total_s, f->place_s, f->bones_s, f->tissue_s);
    printf("%s\n", command_shown(r->out_path));
}

static bool run(run_context *r, err *e)
{
    head_template t = {0};
    head_scan s = {0};
    head_fit f = {0};
    char told[256] = "";
    bool ok = head_template_get(&r->watch, &t, NULL, e) && fit(r, &t, &s, &f, told, e);
    const fit_record of = {r->argument[0], &t, &s, &f, told};
    if (ok) warn(r, &of);
    json_t *record = ok ? record_json(&fit_record_table, &of) : NULL;
    if (ok && command_interrupted()) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    ok = ok && write_all(r, &of, record, e);
    if (ok && r->common.json)
        command_print_record(json_incref(record));
    else if (ok)
        print_plain(r, &of);
    json_decref(record);
    head_fit_free(&f);
    head_scan_free(&s);
    head_template_free(&t);
    return ok;
}

const verb verb_fit = {.arguments = "CASE -o DIR",
                       .about =
                           "Brings the template of heads into the shape of a patient: first as a whole, by the case's "
                           "landmarks or by its surfaces alone, then bent, bones, teeth and soft tissue. Where the "
                           "scan has no surface the shape is guessed, and marked so. DIR/case is a case of its own.",
                       .options = options,
                       .argument_count = 1,
                       .missing_argument = "name a case",
                       .missing_output = "name the folder of results with -o",
                       .need = NEED_CASE | NEED_OUTPUT,
                       .own_size = sizeof(fit_options),
                       .parse = parse,
                       .run = run};
