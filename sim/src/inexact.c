#include "geometry/mem.h"
#include "sim/src/cg.h"
#include "sim/src/clock.h"
#include "sim/src/descent.h"
#include <math.h>
#include <stdlib.h>

enum { CG_MOST = 200, GRID_COST = 20 /* iterations that making a preconditioner is worth */ };

static bool make_grid(descent *d, const double *x, bool *ok, err *e)
{
    solver *t = d->t;
    double *modes = node_blocks_modes(&t->f, &t->b, x);
    multigrid_destroy(&t->grid);
    bool fine = multigrid_make(&t->k, modes, &t->grid, ok, e);
    free(modes);
    t->grid_rate = t->grid_loss = 0;
    if (t->grid) d->out->preconditioners++;
    return fine;
}

bool inexact_matrix(descent *d, const double *x, hessian_kind kind, bool *ok, double *seconds, err *e)
{
    solver *t = d->t;
    double begin = clock_s();
    direct_fill(d, x, kind == HESSIAN_TRUE ? PROJECTION_NONE : d->params->projection);
    if (!t->k.start) {
        t->f = node_blocks_make(&t->b);
        t->k = node_blocks_matrix(&t->f, &t->a);
    }
    node_blocks_fill(&t->f, &t->a, t->a.value, &t->k);
    *ok = true;
    bool fine = true;
    if (!t->grid || t->grid_loss > GRID_COST) fine = make_grid(d, x, ok, e);
    if (fine && !*ok && kind == HESSIAN_TRUE) { /* of the clamped matrix, for the true one */
        direct_fill(d, x, d->params->projection);
        node_blocks_fill(&t->f, &t->a, t->a.value, &t->k);
        fine = make_grid(d, x, ok, e);
        direct_fill(d, x, PROJECTION_NONE);
        node_blocks_fill(&t->f, &t->a, t->a.value, &t->k);
    }
    *seconds += clock_s() - begin;
    return fine;
}

/* A preconditioner ages as the matrix moves away from the one that it was made of. */
static void note_age(solver *t, const cg_result *r)
{
    double digits = -log10(fmax(r->reduction, 1e-12));
    if (r->indefinite || !(digits > 0.3)) return;
    if (t->grid_rate == 0)
        t->grid_rate = r->iterations / digits;
    else
        t->grid_loss += fmax(r->iterations - digits * t->grid_rate, 0);
}

bool inexact_solve(descent *d, const double *b, double rel_tol, double *u, int *cg_iterations, bool *ok, err *e)
{
    solver *t = d->t;
    double begin = clock_s(), *side = NEW_ARRAY(double, 3 * (size_t)t->f.block_count),
           *found = NEW_ARRAY(double, 3 * (size_t)t->f.block_count);
    cg_result r;
    node_blocks_scatter(&t->f, b, side);
    bool fine = cg_solve(&t->k, t->grid, side, found, rel_tol, CG_MOST, &r, e);
    if (fine) {
        node_blocks_gather(&t->f, found, u);
        note_age(t, &r);
        *cg_iterations += r.iterations;
        d->out->cg_iterations += r.iterations;
        *ok = r.indefinite || r.reduction < 0.5;
    }
    free(side);
    free(found);
    d->out->solve_s += clock_s() - begin;
    return fine;
}

/* Eisenstat & Walker 1996, choice 2; never below what the tolerance asks for. */
static double forcing(const descent *d)
{
    double rate = d->residual_before > 0 ? d->residual / d->residual_before : 0.3;
    return fmax(fmin(0.9 * rate * rate, 0.1), 0.5 * d->tolerance / d->residual);
}

bool inexact_direction(descent *d, hessian_kind kind, int *cg_iterations, bool *ok, double *seconds, err *e)
{
    if (!inexact_matrix(d, d->x, kind, ok, seconds, e)) return false;
    if (!*ok) return true;
    if (!inexact_solve(d, d->g, forcing(d), d->direction, cg_iterations, ok, e)) return false;
    for (int64_t i = 0; i < d->t->b.unknown_count; i++) d->direction[i] = -d->direction[i];
    return true;
}
