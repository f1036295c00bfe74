#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/solve/descent.h"
#include <stdlib.h>
#include <string.h>

static const double predict_tol = 2e-3; /* of conjugate gradients: the response is not exact anyway */

double start_reference(descent *d)
{
    solver *t = d->t;
    int64_t n = d->t->b.unknown_count;
    for (int32_t v = 0; v < t->b.node_count; v++) {
        double *p = d->x_new + 3 * (size_t)v;
        if (t->attach->kind[v] == NODE_FREE)
            rigid_apply(&t->b.guide, t->mesh->xyz + 3 * (size_t)v, p);
        else
            vec_copy(t->b.origin + 3 * (size_t)v, p);
    }
    if (isfinite(point_evaluate(d, d->x_new, d->force_new, d->g_new))) return sqrt(point_dot(d->g_new, d->g_new, n));
    /* no energy there (a model that forbids inversion): the linear response instead */
    double *carried = NEW_ARRAY(double, 3 * (size_t)t->b.node_count);
    for (size_t i = 0; i < 3 * (size_t)t->b.node_count; i += 3) {
        rigid_apply(&t->b.guide, t->mesh->xyz + i, carried + i);
        vec_sub(d->x_new + i, carried + i, d->x_new + i);
    }
    assembly_stiffness(&t->a, carried, PROJECTION_NONE);
    free(carried);
    assembly_multiply(&t->a, d->x_new, d->force_new);
    boundary_reduce(&t->b, d->force_new, d->g_new);
    return sqrt(point_dot(d->g_new, d->g_new, n));
}

/* direction = response of the unknowns to the load g_new, about x; *ok false: none. */
static bool respond(descent *d, const double *x_start, double *seconds, int *cg_iterations, bool *ok, err *e)
{
    solver *t = d->t;
    hessian_kind kind = HESSIAN_TRUE;
    *ok = true;
    if (d->inexact) {
        if (!inexact_matrix(d, x_start, kind, true, ok, seconds, e)) return false;
        d->inexact = *ok;
    }
    if (!d->inexact && !direct_factorise(d, x_start, &kind, ok, seconds, e)) return false;
    if (!*ok) return true;
    double *carried = d->x_new; /* what the bones carried nodes by */
    for (size_t i = 0; i < 3 * (size_t)t->b.node_count; i++) carried[i] = d->x[i] - x_start[i];
    assembly_multiply(&t->a, carried, d->force);
    for (size_t i = 0; i < 3 * (size_t)t->b.node_count; i++) d->force[i] += d->force_new[i];
    boundary_reduce(&t->b, d->force, d->g_new);
    if (!d->inexact) return linear_solve(t->l, d->g_new, d->direction, e);
    return inexact_solve(d, d->g_new, predict_tol, d->direction, cg_iterations, ok, e);
}

bool start_predict(descent *d, const double *x_start, double *seconds, int *cg_iterations, bool *ok, err *e)
{
    if (!isfinite(point_evaluate(d, x_start, d->force_new, d->g_new))) {
        *ok = false;
        return true;
    }
    if (d->touching) {
        memcpy(d->force, d->force_new, 3 * (size_t)d->t->b.node_count * sizeof *d->force);
        contact_mark(d->t->touch);
    }
    if (!respond(d, x_start, seconds, cg_iterations, ok, e)) return false;
    if (!*ok) return true;
    for (int64_t i = 0; i < d->t->b.unknown_count; i++) d->z_new[i] = d->z[i] - d->direction[i];
    boundary_place(&d->t->b, d->z_new, d->x_new);
    if (d->touching) contact_retract(d->t->touch, d->t->attach, d->x_new);
    double energy = point_evaluate(d, d->x_new, d->force_new, d->g_new);
    if (d->touching && point_yield(d, d->x_new, d->z_new) > 0)
        energy = point_evaluate(d, d->x_new, d->force_new, d->g_new);
    *ok = isfinite(energy);
    if (*ok) point_accept(d, energy);
    return true;
}
