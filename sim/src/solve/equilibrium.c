#include "sim/src/solve/solver_state.h"
#include <assert.h>
#include <stdlib.h>

const char *solve_outcome_text(solve_outcome outcome)
{
    switch (outcome) {
    case SOLVED: return "solved";
    case STOPPED_MAX_ITERATIONS: return "stopped: too many iterations";
    case STOPPED_LINE_SEARCH: return "stopped: no step lowers the energy";
    case STOPPED_NOT_FINITE: return "stopped: a tet is inverted in a material that forbids it";
    case STOPPED_SINGULAR: return "stopped: the stiffness matrix cannot be made positive definite";
    case STOPPED_MAX_HALVINGS: return "stopped: the load step became too small";
    case STOPPED_MAX_WORK: return "stopped: many times the work of a usual solve brought no equilibrium";
    case STOPPED_PENETRATION: return "stopped: tissue stays too deep in what it touches";
    case STOPPED_INTERRUPTED: return "interrupted";
    }
    assert(0);
    return "";
}

solve_params solve_params_default(void)
{
    return (solve_params){.load_steps = 1,
                          .max_halvings = 8,
                          .max_iterations = 120,
                          .max_work = 600,
                          .max_step_cuts = 20,
                          .rel_tol = 1e-8,
                          .intermediate_rel_tol = 1e-4,
                          .max_step_mm = 30,
                          .predictor = PREDICT_ELASTIC,
                          .projection = PROJECTION_CLAMP,
                          .reuse_factor = true,
                          .blas_threads = 1};
}

bool solve_params_check(const solve_params *p, err *e)
{
    if (p->load_steps < 1) return err_set(e, ERR_INPUT, "load_steps must be >= 1, got %d", p->load_steps);
    if (p->max_halvings < 0) return err_set(e, ERR_INPUT, "max_halvings must be >= 0, got %d", p->max_halvings);
    if (p->max_iterations < 0) return err_set(e, ERR_INPUT, "max_iterations must be >= 0, got %d", p->max_iterations);
    if (p->max_work < 0) return err_set(e, ERR_INPUT, "max_work must be >= 0, got %d", p->max_work);
    if (p->max_step_cuts < 0) return err_set(e, ERR_INPUT, "max_step_cuts must be >= 0, got %d", p->max_step_cuts);
    if (!(p->rel_tol > 0 && p->rel_tol < 1))
        return err_set(e, ERR_INPUT, "rel_tol must lie between 0 and 1, got %g", p->rel_tol);
    if (!(p->intermediate_rel_tol > 0 && p->intermediate_rel_tol < 1))
        return err_set(e, ERR_INPUT, "intermediate_rel_tol must lie between 0 and 1, got %g", p->intermediate_rel_tol);
    if (!(p->least_j >= 0 && p->least_j <= 0.5))
        return err_set(e, ERR_INPUT, "least_j must lie in [0, 0.5], got %g", p->least_j);
    if (!(p->max_step_mm > 0)) return err_set(e, ERR_INPUT, "max_step_mm must be > 0, got %g", p->max_step_mm);
    if (p->projection != PROJECTION_CLAMP && p->projection != PROJECTION_ABS)
        return err_set(e, ERR_INPUT, "projection must be clamp or abs");
    if (p->linear != LINEAR_AUTO && p->linear != LINEAR_FACTOR && p->linear != LINEAR_GRADIENTS)
        return err_set(e, ERR_INPUT, "linear must be auto, factor or gradients");
    if (p->blas_threads < 1) return err_set(e, ERR_INPUT, "blas_threads must be >= 1, got %d", p->blas_threads);
    return true;
}

bool equilibrium_solve(const equilibrium_problem *problem, const solve_params *params, equilibrium *out, err *e)
{
    solver *t = NULL;
    if (!solve_params_check(params, e) || !solver_create(problem, params->blas_threads, &t, e)) return false;
    bool ok = solver_solve(t, problem->motion, problem->start_xyz, params, out, e);
    if (ok) out->total_s += t->prepare_s;
    solver_destroy(&t);
    return ok;
}

void equilibrium_free(equilibrium *q)
{
    free(q->xyz);
    free(q->record);
    *q = (equilibrium){0};
}
