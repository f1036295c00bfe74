#include "app/planner/predict/prediction.h"
#include "app/planner/predict/judge_tissue.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

prediction_options prediction_options_default(void)
{
    return (prediction_options){.contact = CONTACT_BONES,
                                .scene_mm = scene_params_default().tolerance_mm,
                                .rel_tol = solve_params_default().rel_tol,
                                .least_j = 0.05,
                                .model = MATERIAL_SNH_LOG,
                                .skin = true,
                                .points = true,
                                .depth = true};
}

static bool was_interrupted(void *context) { return task_interrupted(context); }

static void tell_iteration(const solve_record *r, void *context)
{
    char stage[96];
    snprintf(stage, sizeof stage, "solving: load %.2f, iteration %d, residual %.2e mN", r->load, r->iteration,
             r->residual_mn);
    task_progress(context, stage, -1);
}

static void set_params(const prediction_options *o, const task *watch, prediction_setup *s)
{
    s->params = solve_params_default();
    s->params.rel_tol = o->rel_tol;
    s->params.least_j = o->least_j;
    if (o->load_steps > 0) s->params.load_steps = o->load_steps;
    s->params.interrupted = was_interrupted;
    s->params.progress = tell_iteration;
    s->params.context = (task *)watch; /* was_interrupted and tell_iteration only read it */
    s->scene = scene_params_default();
    s->scene.full = o->full;
    s->scene.tolerance_mm = o->scene_mm;
}

bool prediction_begin(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                      const prediction_options *options, const task *watch, prediction *out, prediction_setup *setup,
                      err *e)
{
    clock_span begin = clock_now();
    *out = (prediction){0};
    *setup = (prediction_setup){0};
    plan_tissue *flesh = &out->flesh;
    if (!plan_tissue_make(c, p, shapes, moves->move, options->contact == CONTACT_LIPS, options->model, flesh, e))
        return false;
    if (options->contact == CONTACT_BONES)
        flesh->released = plan_contact_release(&p->tissue, shapes, moves->move, &flesh->attach);
    setup->problem = (equilibrium_problem){.mesh = &flesh->mesh,
                                           .attach = &flesh->attach,
                                           .materials = flesh->material,
                                           .material_count = flesh->material_count,
                                           .start_xyz = options->start_xyz};
    memcpy(setup->problem.motion, moves->move, sizeof setup->problem.motion);
    if (options->contact != CONTACT_OFF) {
        plan_contact_make(options->contact, &p->tissue, shapes, &flesh->attach, moves->move,
                          flesh->material[0].material.young_kpa, options->watch_more_mm, &setup->touch);
        setup->problem.contact = &setup->touch.setup;
    }
    set_params(options, watch, setup);
    out->ready_span = clock_lap(&begin);
    return true;
}

void prediction_setup_free(prediction_setup *s)
{
    plan_contact_free(&s->touch);
    *s = (prediction_setup){0};
}

bool prediction_end(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                    const prediction_options *options, prediction *io, err *e)
{
    const equilibrium *q = &io->solve;
    size_t n = 3 * (size_t)q->node_count;
    bool solved = q->outcome == SOLVED;
    clock_span begin = clock_now();
    if (q->outcome == STOPPED_INTERRUPTED) return err_set(e, ERR_INTERRUPTED, "interrupted");
    if (solved) {
        io->u = NEW_ARRAY(double, n);
        for (size_t i = 0; i < n; i++) io->u[i] = q->xyz[i] - p->tissue.mesh.xyz[i];
    }
    if (solved && options->skin) {
        io->skin = surface_copy(&p->skin);
        embedding_apply(&p->skin_on_tissue, &p->tissue.mesh, io->u, p->skin.xyz, io->skin.xyz);
    }
    if (solved && options->points) io->points = carry_landmarks(p, &shapes->carriers, moves, io->u);
    if (solved && options->depth) io->depth = bone_depth_measure(p, shapes, moves, &io->flesh.attach, q->xyz);
    io->limits = options->bones ? *options->bones : (judgement){.reason = -1};
    judge_tissue(c, p, q, io->points.carrier ? &io->points : NULL, &io->limits);
    io->shown_span = clock_lap(&begin);
    return true;
}

/* With shapes. */
static bool make(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                 const prediction_options *options, const task *watch, prediction *out, err *e)
{
    prediction_setup setup;
    bool ok = prediction_begin(c, p, shapes, moves, options, watch, out, &setup, e);
    clock_span begin = clock_now();
    ok = ok && scene_solve(&setup.problem, &setup.scene, &setup.params, &out->solve, &out->scene, e);
    out->solve_span = clock_lap(&begin);
    prediction_setup_free(&setup);
    ok = ok && prediction_end(c, p, shapes, moves, options, out, e);
    if (!ok) prediction_free(out);
    return ok;
}

bool prediction_make(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                     const prediction_options *options, const task *watch, prediction *out, err *e)
{
    if (shapes) return make(c, p, shapes, moves, options, watch, out, e);
    bone_shapes own;
    clock_span begin = clock_now();
    if (!bone_shapes_make(p, &own, e)) return false;
    clock_span shapes_span = clock_lap(&begin);
    bool ok = make(c, p, &own, moves, options, watch, out, e);
    if (ok) out->ready_span = clock_sum(out->ready_span, shapes_span);
    bone_shapes_free(&own);
    return ok;
}

void prediction_free(prediction *p)
{
    free(p->u);
    surface_free(&p->skin);
    carried_landmarks_free(&p->points);
    equilibrium_free(&p->solve);
    scene_report_free(&p->scene);
    plan_tissue_free(&p->flesh);
    *p = (prediction){0};
}
