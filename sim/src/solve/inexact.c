/* Directions by conjugate gradients. */
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "sim/src/linear/cg.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stdlib.h>

static const double near_mm = 0.01;
enum { CG_MOST = 200, GRID_COST = 30 /* iterations that making a preconditioner is worth */ };

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

static bool is_near(const double *a, const double *b, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!(fabs(a[i] - b[i]) < near_mm)) return false;
    return true;
}

bool inexact_matrix(descent *d, const double *x, hessian_kind kind, bool near_enough, bool *ok, double *seconds, err *e)
{
    solver *t = d->t;
    double begin = clock_s();
    if (near_enough && t->matrix_x && is_near(t->matrix_x, x, 3 * (size_t)t->b.node_count))
        assembly_matrix(&t->a, &t->b); /* directions of sliding nodes may have turned */
    else
        direct_fill(d, x, kind == HESSIAN_TRUE ? PROJECTION_NONE : d->params->projection);
    if (!t->k.start) {
        t->f = node_blocks_make(&t->b);
        t->k = node_blocks_matrix(&t->f, &t->a);
    }
    node_blocks_fill(&t->f, &t->a, t->a.value, &t->k);
    *ok = true;
    bool fine = true;
    bool old = t->grid_loss > GRID_COST || (load_touching(&d->load) && contact_stiffness_is_old(t->touch));
    if (!t->grid || old) fine = make_grid(d, x, ok, e);
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

/* With the present matrix. */
static bool gradients(descent *d, const double *b, double rel_tol, double *u, int *cg_iterations, cg_result *r, err *e)
{
    solver *t = d->t;
    double begin = clock_s(), *side = NEW_ARRAY(double, 3 * (size_t)t->f.block_count),
           *found = NEW_ARRAY(double, 3 * (size_t)t->f.block_count);
    node_blocks_scatter(&t->f, b, side);
    bool fine = cg_solve(&t->k, t->grid, side, found, rel_tol, CG_MOST, r, e);
    if (fine) {
        node_blocks_gather(&t->f, found, u);
        *cg_iterations += r->iterations;
        d->out->cg_iterations += r->iterations;
        d->load.cg_iterations += r->iterations;
    }
    free(side);
    free(found);
    d->out->solve_s += clock_s() - begin;
    return fine;
}

bool inexact_solve(descent *d, const double *b, double rel_tol, double *u, int *cg_iterations, bool *ok, err *e)
{
    cg_result r;
    if (!gradients(d, b, rel_tol, u, cg_iterations, &r, e)) return false;
    note_age(d->t, &r);
    *ok = r.indefinite || r.reduction < 0.5;
    return true;
}

/* Eisenstat & Walker 1996, choice 2; never below what the tolerance asks for. */
static double forcing(const descent *d)
{
    double rate = d->load.residual_before > 0 ? d->residual / d->load.residual_before : 0.3;
    double enough = d->residual > d->load.tolerance_mn ? 0.5 * d->load.tolerance_mn / d->residual : 0.1;
    return fmax(fmin(0.9 * rate * rate, 0.1), enough);
}

/* A direction of negative curvature was met after a step that had to be cut, so what the truncated iteration
 * finds is no good guide: between the true matrix, in which a direction of negative curvature was met, and
 * the clamped one, the first in a coarse ladder in which no such direction is met; see direct.c. */
static bool blend(descent *d, step_taken *s, cg_result *r, err *e)
{
    solver *t = d->t;
    assembly *a = &t->a;
    int64_t entries = a->column_start[a->unknown_count];
    double *true_value = COPY_ARRAY(double, a->value, entries), *mixed = NEW_ARRAY(double, entries);
    double part = direct_first_rung(&d->direct);
    bool fine = true;
    direct_fill(d, d->here.x, d->params->projection);
    for (s->kind = HESSIAN_BLENDED; fine && r->indefinite && s->kind == HESSIAN_BLENDED; part *= 2) {
        if (part >= 1) s->kind = HESSIAN_PROJECTED;
        d->direct.blend = fmin(part, 1);
        for (int64_t i = 0; i < entries; i++)
            mixed[i] = true_value[i] + d->direct.blend * (a->value[i] - true_value[i]);
        node_blocks_fill(&t->f, a, mixed, &t->k);
        fine = gradients(d, d->here.g, forcing(d), d->direction, &s->cg_iterations, r, e);
    }
    free(true_value);
    free(mixed);
    return fine;
}

bool inexact_direction(descent *d, step_taken *s, bool *ok, err *e)
{
    cg_result r;
    if (!inexact_matrix(d, d->here.x, s->kind, false, ok, &s->factor_s, e)) return false;
    if (!*ok) return true;
    if (!gradients(d, d->here.g, forcing(d), d->direction, &s->cg_iterations, &r, e)) return false;
    note_age(d->t, &r);
    if (s->kind == HESSIAN_TRUE && r.indefinite && d->load.was_cut && !blend(d, s, &r, e)) return false;
    *ok = r.indefinite || r.reduction < 0.5;
    for (int64_t i = 0; i < d->t->b.unknown_count; i++) d->direction[i] = -d->direction[i];
    return true;
}
