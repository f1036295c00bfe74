/* A load through its phases. */
#include "sim/src/solve/descent.h"
#include <assert.h>
#include <math.h>
#include <stddef.h>

load_phase load_phase_after(const load_state *l)
{
    if (l->over) return LOAD_ENDED;
    switch (l->phase) {
    case LOAD_START: return l->at_rest ? LOAD_WHOLE : l->task.near ? LOAD_NEAR : LOAD_FREE;
    case LOAD_FREE:
    case LOAD_NEAR: return LOAD_WHOLE;
    case LOAD_WHOLE:
    case LOAD_ENDED: break;
    }
    return LOAD_ENDED;
}

static void end(load_state *l, solve_outcome outcome)
{
    l->over = true;
    l->outcome = outcome;
}

static const double least_mm = 1e-9; /* of a step: where bones stay, their move is no measure */

/* At the start, with what is asked of it. */
static void begin(descent *d, const load_task *task, const double *x_start)
{
    solver *t = d->t;
    double reference = start_reference(d), moved = start_bones_move(t);
    double floor = point_force_noise(t, t->mesh->xyz);
    if (task->near) contact_follow(t->touch, t->attach, &t->b, x_start);
    boundary_project(&t->b, x_start, d->here.z);
    boundary_place(&t->b, d->here.z, d->here.x);
    floor = fmax(floor, point_force_noise(t, d->here.x));
    double asked = fmax(task->rel_tol * reference, floor);
    bool on_the_way = task->load < 1 || task->rel_tol * reference <= floor;
    d->out->reference_mn = reference;
    d->load = (load_state){.task = *task,
                           .phase = LOAD_START,
                           .way = step_first_way(d),
                           .asked_mn = asked,
                           .tolerance_mn = asked,
                           .settled_mm = on_the_way ? HUGE_VAL : fmax(sqrt(task->rel_tol) * moved, least_mm)};
    direct_begin_load(&d->direct);
}

static void run_start(descent *d)
{
    load_state *l = &d->load;
    if (l->task.touches) contact_refresh(d->t->touch, d->here.x);
    point_measure(d);
    l->at_rest = isfinite(d->energy) && d->residual <= l->tolerance_mn;
    if (l->at_rest) result_record(d, 0, &(step_taken){0});
}

/* The first guess, with or without contact. */
static bool run_guess(descent *d, const double *x_start, err *e)
{
    step_taken guess = {0};
    bool ok = true;
    if (d->params->predictor == PREDICT_ELASTIC &&
        !start_guess(d, x_start, &guess.factor_s, &guess.cg_iterations, &ok, e))
        return false;
    result_record(d, 0, &guess);
    if (!ok || !isfinite(d->energy)) end(&d->load, STOPPED_NOT_FINITE);
    return true;
}

/* Phase A: where the tissue would go if nothing touched. Its failure only means a worse start for contact. */
static bool run_phase_a(descent *d, err *e)
{
    const contact_params *p = &d->t->touch->setup.params;
    load_state *l = &d->load;
    double tolerance = l->tolerance_mn, settled = l->settled_mm;
    solve_outcome outcome;
    l->tolerance_mn = fmax(tolerance, p->free_rel_tol * d->out->reference_mn);
    l->settled_mm = HUGE_VAL;
    if (!iterate(d, p->free_iterations, &outcome, e)) return false;
    if (outcome_is_final(outcome)) end(l, outcome);
    l->tolerance_mn = tolerance;
    l->settled_mm = settled;
    return true;
}

static bool run_free(descent *d, const double *x_start, err *e)
{
    if (d->load.task.touches) point_measure(d); /* START had measured it with contact */
    if (!run_guess(d, x_start, e)) return false;
    return d->load.over || !d->load.task.free_first || run_phase_a(d, e);
}

static bool run_near(descent *d, const double *x_start, err *e)
{
    step_expect_contact(d);
    return run_guess(d, x_start, e);
}

static bool run_whole(descent *d, err *e)
{
    load_state *l = &d->load;
    if (l->task.touches) {
        contact *c = d->t->touch;
        step_expect_contact(d);
        if (!l->at_rest) {
            if (!l->task.near) direct_expect_deep(&d->direct);
            direct_forget(&d->direct);
            iterate_refresh(d);
            if (c->setup.held && l->task.load == 1 && contact_guard(c, d->here.x)) point_measure(d);
        }
    }
    solve_outcome outcome;
    if (!iterate(d, d->params->max_iterations, &outcome, e)) return false;
    end(l, outcome);
    return true;
}

static bool run_phase(descent *d, const double *x_start, err *e)
{
    switch (d->load.phase) {
    case LOAD_START: run_start(d); return true;
    case LOAD_FREE: return run_free(d, x_start, e);
    case LOAD_NEAR: return run_near(d, x_start, e);
    case LOAD_WHOLE: return run_whole(d, e);
    case LOAD_ENDED: break;
    }
    assert(0);
    return true;
}

bool load_run(descent *d, const load_task *task, const double *x_start, solve_outcome *outcome, err *e)
{
    assert(d->t->touch || !(task->touches || task->near || task->free_first));
    for (begin(d, task, x_start); d->load.phase != LOAD_ENDED; d->load.phase = load_phase_after(&d->load))
        if (!run_phase(d, x_start, e)) return false;
    *outcome = d->load.outcome;
    return true;
}
