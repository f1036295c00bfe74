/* gnathos fit CASE -o DIR: the template of heads in the shape of a patient. */
#include "app/cli/fit_write.h"
#include "app/cli/verb.h"
#include "app/planner/identity/head_complete.h"
#include "app/planner/identity/template_get.h"
#include "geometry/clock.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/fit.h"
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct fit_options {
    bool no_landmarks, no_pictures, complete;
    const char *model;
} fit_options;

enum { KEY_NO_LANDMARKS = KEY_OWN, KEY_NO_PICTURES, KEY_COMPLETE, KEY_MODEL };

static const double range_mm = 2; /* end of the colours: beyond the 1.5 mm that 95 % of a good fit lie within */

static const double told_share = 0.05; /* of a part that is guessed: more is warned of */

static const struct argp_option options[] = {OPTION_OUTPUT("The folder of results, which must not exist yet"),
                                             OPTION_FORCE,
                                             {"no-landmarks", KEY_NO_LANDMARKS, NULL, 0,
                                              "Find the place by the surfaces alone, though the case has landmarks", 0},
                                             {"no-pictures", KEY_NO_PICTURES, NULL, 0, "Leave the pictures out", 0},
                                             {"complete", KEY_COMPLETE, NULL, 0,
                                              "Make a whole head of a scan without skull, mandible or teeth, and close "
                                              "an open mouth by turning the mandible about its condyles",
                                              0},
                                             {"model", KEY_MODEL, "MODEL", 0,
                                              "With --complete: what the scan lacks is that of this model's likeliest "
                                              "head (where absent that of the user's own model, if there is one; none: "
                                              "the mean head's)",
                                              0},
                                             {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    fit_options *o = r->own;
    switch (key) {
    case KEY_NO_LANDMARKS: o->no_landmarks = true; return 0;
    case KEY_NO_PICTURES: o->no_pictures = true; return 0;
    case KEY_COMPLETE: o->complete = true; return 0;
    case KEY_MODEL: o->model = arg; return 0;
    case ARGP_KEY_END:
        if (o->model && !o->complete) command_usage(state, "--model says of what --complete completes; give both");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* Without --complete it has to have all that check asks for. */
static bool open_case(run_context *r, err *e)
{
    const fit_options *o = r->own;
    const char *path = r->argument[0];
    case_file *c = &r->patient;
    if (!case_file_load_skin(path, c, e) || o->complete) return !e->code;
    for (int p = CASE_SKULL; p <= CASE_MANDIBLE; p++)
        if (!*c->surface[p])
            return err_at(e, ERR_INPUT, c->path, 0, p == CASE_SKULL ? "surfaces.skull" : "surfaces.mandible",
                          "is missing; name its file, or let `gnathos fit --complete` guess it");
    return case_file_load(path, c, e);
}

/* The model by which a scan is completed; *found false: by the mean head. */
static bool read_model(const run_context *r, const head_template *t, head_model *m, bool *found, err *e)
{
    const fit_options *o = r->own;
    char own[FIELD_PATH_SIZE];
    *found = false;
    if (!o->complete || (o->model && !strcmp(o->model, "none"))) return true;
    if (!o->model) {
        if (!head_model_place(own, e)) return false;
        if (access(own, F_OK) != 0) {
            command_note(&r->common, "what is missing will be the mean head's: there is no model %s", own);
            return true;
        }
        command_note(&r->common, "what is missing will be that of the likeliest head of %s", own);
    }
    *found = head_model_read(o->model ? o->model : own, t, m, e);
    return *found;
}

static bool fit(run_context *r, const head_template *t, head_scan *s, head_fit *out, head_completion *how,
                char told[256], err *e)
{
    const fit_options *o = r->own;
    head_fit_params p = head_fit_params_default();
    head_model m = {0};
    head_place place;
    bool has_model;
    if (!read_model(r, t, &m, &has_model, e)) return false;
    double start = clock_s(), placed_s = 0;
    bool ok = head_scan_read(&r->patient, !o->no_landmarks, s, e);
    if (ok) task_progress(&r->watch, "place", 0);
    ok = ok && head_place_find(t, s, &r->watch, &place, told, e);
    placed_s = clock_s() - start;
    if (ok && *told) command_note(&r->common, "%s", told);
    if (ok && o->complete)
        ok = head_complete(t, s, has_model ? &m : NULL, &place, &r->watch, out, how, e);
    else
        ok = ok && head_fit_from(t, s, &p, &place, &r->watch, out, e);
    head_model_free(&m);
    out->place_s = placed_s;
    out->total_s += placed_s;
    return ok;
}

static bool write_pictures(const run_context *r, const fit_record *of, err *e)
{
    const fit_options *o = r->own;
#if GNATHOS_WITH_RENDER
    if (o->no_pictures) return true;
    static const char *const name[] = {"residual_skin.png", "residual_bones.png", "residual_scan.png", "beside.png"};
    const fit_pictures p = {of->head, of->fit, of->scan, r->patient.name};
    bool ok = true;
    command_progress_at(&r->common, "drawing", -1);
    for (int i = 0; ok && i < 4; i++) {
        char *path = output_dir_file(&r->dir, name[i]);
        ok = i < 2    ? fit_residual_write(&p, i, range_mm, path, e)
             : i == 2 ? fit_scan_write(&p, range_mm, path, e)
                      : fit_beside_write(&p, path, e);
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

static void warn_part(const run_context *r, const fit_record *of, case_surface p)
{
    double absent = fit_share(of->fit, p, GUESS_ABSENT), closed = fit_share(of->fit, p, GUESS_CLOSED),
           missed = fit_share(of->fit, p, GUESS_MISSED);
    if (absent > told_share)
        command_note(&r->common, "%s: warning: %.0f %% of it is guessed from the %s: the scan has %s",
                     case_surface_name(p), 100 * absent,
                     of->completion && of->completion->likeliest.mode_count ? "model" : "template",
                     of->scan->part[p].triangle_count ? "nothing there" : "no such surface");
    if (missed > told_share)
        command_note(&r->common,
                     "%s: warning: %.0f %% of it is missed: the scan has a surface there, more than %g mm off",
                     case_surface_name(p), 100 * missed, fit_found_mm);
    if (closed > 0)
        command_note(&r->common,
                     "%s: warning: %.0f %% of it is guessed: it went with the mouth, which the scan has open",
                     case_surface_name(p), 100 * closed);
}

static void warn(const run_context *r, const fit_record *of)
{
    char text[160];
    if (of->completion && of->completion->jaw.stop != JAW_NOT_OPEN)
        command_note(&r->common, "warning: the bite is guessed: %s",
                     head_closing_text(&of->completion->jaw, text, sizeof text));
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) warn_part(r, of, (case_surface)p);
}

static void print_gaps(const registration_gaps *g)
{
    if (g->with_target)
        printf(" %8.2f %8.2f %8.2f", g->mean_mm, g->p95_mm, g->max_mm);
    else
        printf(" %8s %8s %8s", "-", "-", "-");
}

static void print_plain(const run_context *r, const fit_record *of)
{
    const head_fit *f = of->fit;
    char text[160];
    printf("%s: placed by %s, turned by %.1f deg, size %.3f of the template's\n", r->patient.name,
           f->place.by_landmarks ? "landmarks" : "its surfaces", rigid_angle(&f->place.motion) * 180 / 3.14159265358979,
           f->place.scale);
    printf("%-14s %26s   %26s\n", "distance, mm", "template to scan", "scan to template");
    printf("%-14s %8s %8s %8s   %8s %8s %8s %9s %8s\n", "", "mean", "95 %", "largest", "mean", "95 %", "largest",
           "guessed", "missed");
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        printf("%-14s", case_surface_name((case_surface)p));
        print_gaps(&f->gaps[p]);
        printf("  ");
        print_gaps(&f->back[p]);
        printf(" %7.1f %% %6.1f %%\n", 100 * fit_guessed_share(f, (case_surface)p),
               100 * fit_share(f, (case_surface)p, GUESS_MISSED));
    }
    if (of->completion) printf("%s\n", head_closing_text(&of->completion->jaw, text, sizeof text));
    printf("guessed: where the scan has no surface the shape is the template's, bent along; missed: it has one, %g to "
           "%g mm off\n",
           fit_found_mm, fit_missed_mm);
    printf("tissue: smallest J %.3f, %d tets inside out; %.1f s (place %.1f, bones %.1f, tissue %.1f)\n", f->min_j,
           f->inverted_tets, f->total_s, f->place_s, f->bones_s, f->tissue_s);
    printf("%s\n", command_shown(r->out_path));
}

static bool run(run_context *r, err *e)
{
    head_template t = {0};
    head_scan s = {0};
    head_fit f = {0};
    head_completion how = {0};
    char told[256] = "";
    bool ok = head_template_get(&r->watch, &t, NULL, e) && fit(r, &t, &s, &f, &how, told, e);
    const fit_record of = {r->argument[0], &t, &s, &f, told, ((fit_options *)r->own)->complete ? &how : NULL};
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
                       .need = NEED_OUTPUT,
                       .own_size = sizeof(fit_options),
                       .parse = parse,
                       .early = open_case,
                       .run = run};
