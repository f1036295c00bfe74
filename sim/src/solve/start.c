/* Where a load begins: what it is measured by, and the first guess. */
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double predict_tol = 2e-3; /* of conjugate gradients: the response is not exact anyway */

double start_reference(descent *d)
{
    solver *t = d->t;
    int64_t n = d->t->b.unknown_count;
    for (int32_t v = 0; v < t->b.node_count; v++) {
        double *p = d->trial.x + 3 * (size_t)v;
        if (t->attach->kind[v] == NODE_FREE)
            rigid_apply(&t->b.guide, t->mesh->xyz + 3 * (size_t)v, p);
        else
            vec_copy(t->b.origin + 3 * (size_t)v, p);
    }
    if (isfinite(point_evaluate(d, false, d->trial.x, &d->trial))) return sqrt(point_dot(d->trial.g, d->trial.g, n));
    /* no energy there (a model that forbids inversion): the linear response instead */
    double *carried = NEW_ARRAY(double, 3 * (size_t)t->b.node_count);
    for (size_t i = 0; i < 3 * (size_t)t->b.node_count; i += 3) {
        rigid_apply(&t->b.guide, t->mesh->xyz + i, carried + i);
        vec_sub(d->trial.x + i, carried + i, d->trial.x + i);
    }
    solver_forget_blocks(t);
    term_stiffness(&t->terms, false, carried, NULL, PROJECTION_NONE, &t->a);
    free(carried);
    assembly_multiply(&t->a, d->trial.x, d->trial.force);
    boundary_reduce(&t->b, d->trial.force, d->trial.g);
    return sqrt(point_dot(d->trial.g, d->trial.g, n));
}

double start_bones_move(const solver *t)
{
    double most = t->touch ? t->touch->motion_reach_mm : 0;
    for (int32_t v = 0; v < t->b.node_count; v++) {
        double carried[3];
        if (t->attach->kind[v] == NODE_FREE) continue;
        rigid_apply(&t->b.guide, t->mesh->xyz + 3 * (size_t)v, carried);
        most = fmax(most, vec_distance(carried, t->b.origin + 3 * (size_t)v));
    }
    return t->pull ? fmax(most, target_pull_longest(t->pull, t->mesh->xyz)) : most;
}

/* direction = response of the unknowns to the load trial.g, about x_start; *ok false: none. */
static bool respond(descent *d, const double *x_start, double *seconds, int *cg_iterations, bool *ok, err *e)
{
    solver *t = d->t;
    hessian_kind kind = HESSIAN_TRUE;
    bool kept = t->factor_used && d->load.way == BY_FACTORS;
    *ok = true;
    t->factor_used = false;
    if (d->load.way == BY_GRADIENTS) {
        if (!inexact_matrix(d, x_start, kind, true, ok, seconds, e)) return false;
        if (!*ok) d->load.way = BY_FACTORS;
    }
    if (kept)
        direct_adopt(&d->direct, d->residual);
    else if (d->load.way == BY_FACTORS && !direct_factorise(d, x_start, &kind, ok, seconds, e))
        return false;
    if (!*ok) return true;
    double *carried = d->trial.x; /* what the bones carried nodes by */
    for (size_t i = 0; i < 3 * (size_t)t->b.node_count; i++) carried[i] = d->here.x[i] - x_start[i];
    assembly_multiply(&t->a, carried, d->here.force);
    for (size_t i = 0; i < 3 * (size_t)t->b.node_count; i++) d->here.force[i] += d->trial.force[i];
    boundary_reduce(&t->b, d->here.force, d->trial.g);
    if (d->load.way == BY_FACTORS) return linear_solve(t->l, d->trial.g, d->direction, e);
    return inexact_solve(d, d->trial.g, predict_tol, d->direction, cg_iterations, ok, e);
}

bool start_guess(descent *d, const double *x_start, double *seconds, int *cg_iterations, bool *ok, err *e)
{
    bool touching = load_touching(&d->load);
    if (!isfinite(point_evaluate(d, touching, x_start, &d->trial))) {
        *ok = false;
        return true;
    }
    if (touching) {
        memcpy(d->here.force, d->trial.force, 3 * (size_t)d->t->b.node_count * sizeof *d->here.force);
        contact_mark(d->t->touch);
    }
    if (!respond(d, x_start, seconds, cg_iterations, ok, e)) return false;
    if (!*ok) return true;
    for (int64_t i = 0; i < d->t->b.unknown_count; i++) d->trial.z[i] = d->here.z[i] - d->direction[i];
    boundary_place(&d->t->b, d->trial.z, d->trial.x);
    if (touching) contact_retract(d->t->touch, d->t->attach, d->trial.x);
    double energy = point_evaluate(d, touching, d->trial.x, &d->trial);
    if (touching && point_yield(d, &d->trial) > 0) energy = point_evaluate(d, touching, d->trial.x, &d->trial);
    *ok = isfinite(energy);
    if (*ok) point_accept(d, energy);
    return true;
}
