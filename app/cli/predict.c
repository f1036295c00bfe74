/* gnathos predict CASE --plan P -o OUT: the face after a plan. */
#include "app/cli/outcome_print.h"
#include "app/cli/verb.h"
#include "app/planner/judge/plan_audit.h"
#include "app/planner/predict/outcome_record.h"
#include "geometry/clock.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/standard.h"
#include <sys/stat.h>
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_NO_PICTURES = KEY_OWN, KEY_CONTACT, KEY_FULL };

typedef struct predict_options {
    bool no_pictures, full;
    contact_kind contact;
} predict_options;

static const struct argp_option options[] = {
    OPTION_PLAN("The plan: bone moves as JSON (gnathos help plan)", 0),
    OPTION_OUTPUT("Folder for the results"),
    OPTION_FORCE,
    {"no-pictures", KEY_NO_PICTURES, NULL, 0, "Leave the pictures out", 0},
    {"contact", KEY_CONTACT, "KIND", 0,
     "bones (default: tissue enters no bone), lips (and lips may part and mucosa lift off), off", 0},
    {"full", KEY_FULL, NULL, 0, "Solve for all tissue, also where it hardly moves", 0},
    OPTION_CACHE,
    {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    predict_options *o = r->own;
    switch (key) {
    case KEY_NO_PICTURES: o->no_pictures = true; return 0;
    case KEY_CONTACT:
        if (!contact_kind_find(arg, &o->contact)) command_usage(state, "--contact is bones, lips or off, not %s", arg);
        return 0;
    case KEY_FULL: o->full = true; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

#if GNATHOS_WITH_RENDER
static bool draw(const outcome *o, const output_dir *dir, err *e)
{
    char *folder = output_dir_file(dir, "pictures");
    pictures_input in = {.case_name = o->patient->name,
                         .plan_text = o->plan->name,
                         .hash = o->prepared->hash,
                         .skin_before = &o->prepared->skin,
                         .skin_after = o->skin,
                         .at_rest = &o->prepared->segments,
                         .move = o->moves->move,
                         .before = &o->prepared->points,
                         .after = &o->points->after,
                         .frame = &o->prepared->frame};
    bool ok = mkdir(folder, 0777) == 0 ? pictures_write(&in, folder, e)
                                       : err_at(e, ERR_RESOURCE, folder, 0, NULL, "cannot be made");
    free(folder);
    return ok;
}
#endif

/* Writes the output folder. Only an equilibrium becomes meshes and pictures; a failed solve leaves its record, which
 * the caller frees. */
static bool write_all(const run_context *r, outcome *o, json_t **record, err *e)
{
    const output_dir *dir = &r->dir;
    bool ok = true;
    clock_span begin = clock_now();
    if (o->points) {
        command_progress_at(&r->common, "writing the meshes", 0.8);
        ok = outcome_write_meshes(o, dir, e);
        o->stages.write = clock_lap(&begin);
#if GNATHOS_WITH_RENDER
        const predict_options *in = r->own;
        if (ok && !in->no_pictures) {
            command_progress_at(&r->common, "drawing the pictures", 0.85);
            ok = draw(o, dir, e);
        }
#endif
        o->stages.pictures = clock_lap(&begin);
    }
    if (ok && command_interrupted()) ok = err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
    if (ok) {
        char *path = output_dir_file(dir, "outcome.json");
        *record = outcome_json(o);
        ok = json_file_write(*record, path, e);
        free(path);
    }
    return ok;
}

/* The limits of bone and teeth come before the solve: a plan that passes one is refused unless it says why. */
static bool judge_bones_first(const run_context *r, judgement *out, err *e)
{
    judge *j;
    command_progress_at(&r->common, "judging the plan", 0.45);
    if (!judge_create(&r->patient, &r->prepared, &j, e)) return false;
    judge_plan(j, &r->moves, out);
    judge_free(&j);
    return judgement_allows(out, &r->patient, &r->plan, e);
}

static bool predict(const run_context *r, const judgement *limits, prediction *out, err *e)
{
    const predict_options *in = r->own;
    prediction_options asked = prediction_options_default();
    asked.contact = in->contact;
    asked.full = in->full;
    asked.load_steps = r->plan.load_steps;
    asked.bones = limits;
    if (prediction_make(&r->patient, &r->prepared, NULL, &r->moves, &asked, &r->watch, out, e)) return true;
    if (e->code != ERR_INTERRUPTED) return false;
    *e = (err){0};
    return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
}

static void defaults(void *own) { *(predict_options *)own = (predict_options){.contact = CONTACT_BONES}; }

/* How it ended, and where. */
static bool refuse_unsolved(const run_context *r, const outcome *o, err *e)
{
    char where[128] = "";
    double at[3];
    const char *near = outcome_stuck(o, at);
    if (near)
        snprintf(where, sizeof where, ", most of the force that is left at (%.1f, %.1f, %.1f) mm near %s", at[0], at[1],
                 at[2], near);
    return err_set(
        e, ERR_NOT_CONVERGED,
        "%s: the solve did not reach equilibrium (%s%s), so there is no face to show; %s/outcome.json has its "
        "record",
        r->plan_path, solve_outcome_text(o->solve->outcome), where, r->out_path);
}

static bool run(run_context *r, err *e)
{
    const predict_options *in = r->own;
    clock_span begin = r->start, opened = clock_lap(&begin);
    judgement limits;
    prediction made;
    if (!judge_bones_first(r, &limits, e)) return false;
    clock_span judged = clock_lap(&begin);
    if (!predict(r, &limits, &made, e)) return false;
    outcome o = outcome_of(&r->patient, &r->prepared, &r->plan, &r->moves, in->contact, &made);
    o.stages.prepare = opened;
    o.stages.judge = judged;
    bool solved = made.solve.outcome == SOLVED, ok;
    json_t *record = NULL;
    ok = write_all(r, &o, &record, e) && output_dir_close(&r->dir, e);
    if (ok && r->common.json) {
        command_print_record(json_incref(record));
    } else if (ok) {
        outcome_print(&o);
        if (solved) printf("Results in %s\n", command_shown(r->out_path));
    }
    json_decref(record);
    ok = ok && (solved || refuse_unsolved(r, &o, e));
    prediction_free(&made);
    return ok;
}

const verb verb_predict = {.arguments = "CASE",
                           .about = "Predict the face after a plan.",
                           .options = options,
                           .argument_count = 1,
                           .missing_argument = "name a case",
                           .missing_plan = "name a plan with --plan",
                           .missing_output = "name a folder for the results with -o",
                           .need = NEED_CASE | NEED_POINTS | NEED_PLAN | NEED_OUTPUT | NEED_PREPARED,
                           .own_size = sizeof(predict_options),
                           .defaults = defaults,
                           .parse = parse,
                           .run = run};
