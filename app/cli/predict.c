/* gnathos predict CASE --plan P -o OUT: the face after a plan. */
#include "app/cli/command.h"
#include "app/cli/outcome_print.h"
#include "app/planner/predict/judge_tissue.h"
#include "app/planner/predict/outcome.h"
#include "app/planner/judge/plan_audit.h"
#include "app/planner/predict/plan_contact.h"
#include "app/planner/predict/plan_tissue.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
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

static bool was_interrupted(void *context)
{
    (void)context;
    return command_interrupted();
}

static void show_iteration(const solve_record *r, void *context)
{
    char stage[96];
    snprintf(stage, sizeof stage, "solving: load %.2f, iteration %d, residual %.2e mN", r->load, r->iteration,
             r->residual_mn);
    command_progress_at(context, stage, -1);
}

static bool solve(const plan_file *plan, const plan_moves *moves, const prepared *p, const bone_shapes *bones,
                  const plan_tissue *t, const struct input *in, equilibrium *out, scene_report *scene, err *e)
{
    equilibrium_problem problem = {
        .mesh = &t->mesh, .attach = &t->attach, .materials = t->material, .material_count = t->material_count};
    for (int s = 0; s < SEGMENT_COUNT; s++) problem.motion[s] = moves->move[s];
    solve_params params = solve_params_default();
    if (plan->load_steps > 0) params.load_steps = plan->load_steps;
    params.interrupted = was_interrupted;
    params.progress = show_iteration;
    params.context = (command_options *)&in->common;
    scene_params needs = scene_params_default();
    needs.full = in->full;
    plan_contact touch = {0};
    if (in->contact != CONTACT_OFF) {
        plan_contact_make(in->contact, &p->tissue, bones, &t->attach, moves->move, t->material[0].material.young_kpa,
                          &touch);
        problem.contact = &touch.setup;
    }
    bool ok = scene_solve(&problem, &needs, &params, out, scene, e);
    plan_contact_free(&touch);
    return ok;
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

static bool predict(const struct input *in, const case_file *c, const prepared *p, double prepare_s, output_dir *dir,
                    bool *solved, err *e)
{
    plan_file plan;
    plan_moves moves;
    judgement limits;
    if (!plan_moves_load(in->plan, c, &p->points, &plan, &moves, e) ||
        !judge_bones_first(in, c, p, &plan, &moves, &limits, e))
        return false;
    equilibrium q = {0};
    scene_report scene = {0};
    plan_tissue flesh = {0};
    bone_shapes bones;
    double start = clock_s();
    if (!bone_shapes_make(p, &bones, e)) return false;
    bool ready = plan_tissue_make(c, p, moves.move, in->contact == CONTACT_LIPS, &flesh, e);
    if (ready && in->contact == CONTACT_BONES)
        flesh.released = plan_contact_release(&p->tissue, &bones, moves.move, &flesh.attach);
    if (!ready || !solve(&plan, &moves, p, &bones, &flesh, in, &q, &scene, e)) {
        plan_tissue_free(&flesh);
        bone_shapes_free(&bones);
        return false;
    }
    outcome o = {.patient = c,
                 .plan = &plan,
                 .moves = &moves,
                 .prepared = p,
                 .tissue = &flesh,
                 .solve = &q,
                 .scene = &scene,
                 .prepare_s = prepare_s,
                 .solve_s = clock_s() - start,
                 .limits = &limits,
                 .contact = in->contact};
    *solved = q.outcome == SOLVED;
    carried_landmarks points = {0};
    bone_depth depth = {0};
    surface skin = {0};
    double *u = NEW_ARRAY(double, 3 * (size_t)q.node_count);
    bool ok = q.outcome != STOPPED_INTERRUPTED || err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
    if (ok && *solved) {
        for (size_t i = 0; i < 3 * (size_t)q.node_count; i++) u[i] = q.xyz[i] - p->tissue.mesh.xyz[i];
        skin = surface_copy(&p->skin);
        embedding_apply(&p->skin_on_tissue, &p->tissue.mesh, u, p->skin.xyz, skin.xyz);
        ok = carry_landmarks(p, &moves, u, &points, e) &&
             bone_depth_measure(p, &bones, &moves, &flesh.attach, q.xyz, &depth, e);
        o.depth = &depth;
        o.u = u;
        o.skin = &skin;
        o.points = &points;
    }
    judge_tissue(c, p, &q, o.points, &limits);
    ok = ok && write_all(in, &o, dir, e) && output_dir_close(dir, e);
    if (ok && in->common.json)
        command_print_json(outcome_json(&o), "predict");
    else if (ok) {
        outcome_print(&o);
        if (*solved) printf("Results in %s\n", in->out);
    }
    free(u);
    surface_free(&skin);
    carried_landmarks_free(&points);
    equilibrium_free(&q);
    scene_report_free(&scene);
    plan_tissue_free(&flesh);
    bone_shapes_free(&bones);
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
    bool ok = predict(&in, &c, &p, clock_s() - start, &dir, &solved, &e);
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
