/* gnathos predict CASE --plan P -o OUT: the face after a plan. */
#include "app/cli/command.h"
#include "app/cli/outcome_print.h"
#include "app/planner/judge/plan_audit.h"
#include "app/planner/predict/outcome.h"
#include "geometry/clock.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/standard.h"
#include <sys/stat.h>
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct input {
    command_options common;
    const char *case_path[1], *plan, *out, *cache;
    bool force, no_pictures, full;
    contact_kind contact;
};

enum { KEY_CACHE = 300, KEY_NO_PICTURES, KEY_CONTACT, KEY_FULL };

static const struct argp_option options[] = {
    {"plan", 'p', "FILE", 0, "The plan: bone moves as JSON (gnathos help plan)", 0},
    {"output", 'o', "DIR", 0, "Folder for the results", 0},
    {"force", 'f', NULL, 0, "Replace an earlier output in DIR", 0},
    {"no-pictures", KEY_NO_PICTURES, NULL, 0, "Leave the pictures out", 0},
    {"contact", KEY_CONTACT, "KIND", 0,
     "bones (default: tissue enters no bone), lips (and lips may part and mucosa lift off), off", 0},
    {"full", KEY_FULL, NULL, 0, "Solve for all tissue, also where it hardly moves", 0},
    {"cache", KEY_CACHE, "DIR", 0, "Keep what is prepared in DIR instead of CASE/prepared", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &in->common;
        in->contact = CONTACT_BONES;
        return 0;
    case 'p': in->plan = arg; return 0;
    case 'o': in->out = arg; return 0;
    case 'f': in->force = true; return 0;
    case KEY_NO_PICTURES: in->no_pictures = true; return 0;
    case KEY_CONTACT:
        if (!contact_kind_find(arg, &in->contact)) argp_error(state, "--contact is bones, lips or off, not %s", arg);
        return 0;
    case KEY_FULL: in->full = true; return 0;
    case KEY_CACHE: in->cache = arg; return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->case_path, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name a case"); return 0;
    case ARGP_KEY_END:
        if (!in->plan) argp_error(state, "name a plan with --plan");
        if (!in->out) argp_error(state, "name a folder for the results with -o");
        return 0;
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

/* Writes the output folder. Only an equilibrium becomes meshes and pictures; a failed solve leaves its record. */
static bool write_all(const struct input *in, outcome *o, output_dir *dir, err *e)
{
    bool ok = true;
    double start = clock_s();
    if (o->points) {
        command_progress_at(&in->common, "writing the meshes", 0.8);
        ok = outcome_write_meshes(o, dir, e);
        o->write_s = clock_s() - start;
#if GNATHOS_WITH_RENDER
        if (ok && !in->no_pictures) {
            command_progress_at(&in->common, "drawing the pictures", 0.85);
            ok = draw(o, dir, e);
        }
#endif
        o->pictures_s = clock_s() - start - o->write_s;
    }
    if (ok && command_interrupted()) ok = err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
    if (ok) {
        char *path = output_dir_file(dir, "outcome.json");
        json_t *record = outcome_json(o);
        ok = json_file_write(record, path, e);
        json_decref(record);
        free(path);
    }
    return ok;
}

/* The limits of bone and teeth come before the solve: a plan that passes one is refused unless it says why. */
static bool judge_bones_first(const struct input *in, const case_file *c, const prepared *p, const plan_file *plan,
                              const plan_moves *moves, judgement *out, err *e)
{
    judge *j;
    command_progress_at(&in->common, "judging the plan", 0.45);
    if (!judge_create(c, p, &j, e)) return false;
    judge_plan(j, moves, out);
    judge_free(&j);
    return judgement_allows(out, c, plan, e);
}

static bool predict(const struct input *in, const case_file *c, const prepared *p, double prepare_s, const task *watch,
                    output_dir *dir, bool *solved, err *e)
{
    plan_file plan;
    plan_moves moves;
    judgement limits;
    if (!plan_moves_load(in->plan, c, &p->points, &plan, &moves, e) ||
        !judge_bones_first(in, c, p, &plan, &moves, &limits, e))
        return false;
    prediction_options asked = prediction_options_default();
    prediction made;
    asked.contact = in->contact;
    asked.full = in->full;
    asked.load_steps = plan.load_steps;
    asked.bones = &limits;
    if (!prediction_make(c, p, NULL, &moves, &asked, watch, &made, e)) {
        if (e->code != ERR_INTERRUPTED) return false;
        *e = (err){0};
        return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
    }
    outcome o = outcome_of(c, p, &plan, &moves, in->contact, &made);
    o.prepare_s = prepare_s;
    *solved = made.solve.outcome == SOLVED;
    bool ok = write_all(in, &o, dir, e) && output_dir_close(dir, e);
    if (ok && in->common.json)
        command_print_json(outcome_json(&o), "predict");
    else if (ok) {
        outcome_print(&o);
        if (*solved) printf("Results in %s\n", in->out);
    }
    prediction_free(&made);
    return ok;
}

int command_predict(int argc, char **argv)
{
    static const struct argp argp = {options,        parse, "CASE", "Predict the face after a plan.",
                                     command_common, NULL,  NULL};
    struct input in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    const task watch = command_task(&in.common);
    err e = {0};
    case_file c;
    landmarks points = {0};
    plan_file plan;
    plan_moves moves;
    prepared p = {0};
    bool solved = false;
    double start = clock_s();
    output_dir dir = {0};
    /* a wrong plan or folder is told before the minutes of preparation */
    if (!case_file_load(in.case_path[0], &c, &e) || !landmarks_read(c.landmarks, &points, NULL, &e) ||
        !plan_moves_load(in.plan, &c, &points, &plan, &moves, &e) || !output_dir_open(in.out, in.force, &dir, &e))
        return command_fail(&e);
    if (!prepared_get(&c, in.cache, &watch, &p, &e)) {
        output_dir_abandon(&dir);
        return command_fail(&e);
    }
    landmarks_free(&points);
    bool ok = predict(&in, &c, &p, clock_s() - start, &watch, &dir, &solved, &e);
    prepared_free(&p);
    if (!ok) {
        output_dir_abandon(&dir);
        return command_fail(&e);
    }
    if (!solved) {
        err_set(&e, ERR_NOT_CONVERGED,
                "%s: the solve did not reach equilibrium, so there is no face to show; %s/outcome.json "
                "has its record",
                in.plan, in.out);
        return command_fail(&e);
    }
    return 0;
}
