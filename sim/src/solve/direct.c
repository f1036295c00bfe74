#include "geometry/mem.h"
#include "geometry/vec.h"
#include "geometry/clock.h"
#include "sim/src/solve/descent.h"
#include <stdlib.h>
#include <string.h>

static const double least_part = 1.0 / 64; /* below, the true matrix itself is tried */

/* Each rung of the ladder is so many times the one before. */
static double rung(const descent *d) { return d->touching ? 4 : 2; }

double direct_first_rung(const descent *d)
{
    static const double least = 1.0 / 256, below = 4; /* the last one used may be more than is needed now */
    return fmax(d->blend / below, least);
}

void direct_fill(descent *d, const double *x, projection how)
{
    assembly *a = &d->t->a;
    double begin = clock_s();
    free(d->t->matrix_x);
    d->t->matrix_x = NULL;
    if (d->inexact && !d->touching && how == PROJECTION_NONE)
        d->t->matrix_x = COPY_ARRAY(double, x, 3 * (size_t)a->node_count);
    assembly_stiffness(a, x, how);
    if (d->touching) contact_stiffness(d->t->touch, x, d->force, how == PROJECTION_NONE, a);
    assembly_matrix(a, &d->t->b);
    d->out->assemble_s += clock_s() - begin;
}

/* Between the true matrix, which is not positive definite, and the clamped one, which is: the first in a
 * coarse ladder that is. Next to a buckling tissue the clamped matrix is far too stiff along the very mode
 * that wants to move, and residuals crawl; little of it is enough to give that mode a long way down. */
static bool factorise_blend(descent *d, const double *true_value, double part, bool *ok, err *e)
{
    assembly *a = &d->t->a;
    int64_t entries = a->column_start[d->t->b.unknown_count];
    double *mixed = NEW_ARRAY(double, entries);
    bool fine = true;
    for (; fine && !*ok && part < 1; part *= rung(d)) {
        for (int64_t i = 0; i < entries; i++) mixed[i] = true_value[i] + part * (a->value[i] - true_value[i]);
        fine = linear_factor(d->t->l, mixed, 0, ok, e);
        d->blend = part;
    }
    if (fine && !*ok) d->blend = 1;
    free(mixed);
    return fine;
}

/* What the last matrix needed tells where to begin: there, where it took several tries, and lower where the
 * first was enough, down to the true matrix. */
static double first_part(const descent *d)
{
    if (!d->touching || d->blend_tries == 0) return 0;
    return d->blend_tries > 1 ? d->blend : d->blend / rung(d);
}

bool direct_factorise(descent *d, const double *x, hessian_kind *kind, bool *ok, double *seconds, err *e)
{
    assembly *a = &d->t->a;
    double begin = clock_s();
    *ok = false;
    d->pair_count = 0;
    d->has_factor = false;
    if (!solver_order(d->t, e)) return false;
    double part = first_part(d);
    int before = linear_measure(d->t->l).factorisations;
    if (*kind == HESSIAN_TRUE && part < 1) {
        bool whole = part < least_part;
        direct_fill(d, x, PROJECTION_NONE);
        if (whole && !linear_factor(d->t->l, a->value, 0, ok, e)) return false;
        d->blend_tries = 0;
        if (!*ok) {
            double *true_value = COPY_ARRAY(double, a->value, a->column_start[d->t->b.unknown_count]);
            direct_fill(d, x, d->params->projection);
            *kind = HESSIAN_BLENDED;
            bool fine = factorise_blend(d, true_value, whole ? direct_first_rung(d) : part, ok, e);
            d->blend_tries = linear_measure(d->t->l).factorisations - before;
            free(true_value);
            if (!fine) return false;
        }
    } else {
        direct_fill(d, x, d->params->projection);
        d->blend = 1;
        d->blend_tries = 1;
    }
    if (!*ok && *kind <= HESSIAN_PROJECTED) {
        *kind = HESSIAN_PROJECTED;
        if (!linear_factor(d->t->l, a->value, 0, ok, e)) return false;
    }
    if (!*ok) {
        *kind = HESSIAN_SHIFTED;
        double mean = 0;
        for (int64_t j = 0; j < d->t->b.unknown_count; j++)
            mean += fabs(a->value[a->column_start[j]]) / (double)d->t->b.unknown_count;
        for (double shift = 1e-3; !*ok && shift < 1e3; shift *= 10)
            if (!linear_factor(d->t->l, a->value, shift * mean, ok, e)) return false;
    }
    d->has_factor = *ok;
    d->since_factor = 0;
    d->residual_at_factor = d->residual;
    *seconds += clock_s() - begin;
    return true;
}

/* direction = -(inverse Hessian) g; two-loop recursion, Nocedal & Wright 2006, algorithm 7.4. */
bool direct_direction(descent *d, err *e)
{
    int64_t n = d->t->b.unknown_count;
    double *q = d->direction, alpha[PAIR_LIMIT];
    memcpy(q, d->g, (size_t)n * sizeof *q);
    for (int k = d->pair_count - 1; k >= 0; k--) {
        alpha[k] = d->pair_rho[k] * point_dot(d->pair_s[k], q, n);
        for (int64_t i = 0; i < n; i++) q[i] -= alpha[k] * d->pair_y[k][i];
    }
    if (!linear_solve(d->t->l, q, q, e)) return false;
    for (int k = 0; k < d->pair_count; k++) {
        double beta = d->pair_rho[k] * point_dot(d->pair_y[k], q, n);
        for (int64_t i = 0; i < n; i++) q[i] += (alpha[k] - beta) * d->pair_s[k][i];
    }
    for (int64_t i = 0; i < n; i++) q[i] = -q[i];
    return true;
}

void direct_remember(descent *d)
{
    int64_t n = d->t->b.unknown_count;
    double sy = 0, yy = 0, ss = 0;
    for (int64_t i = 0; i < n; i++) {
        double s = d->z[i] - d->z_new[i], y = d->g[i] - d->g_new[i];
        sy += s * y;
        yy += y * y;
        ss += s * s;
    }
    if (!(sy > 1e-10 * sqrt(ss * yy))) return; /* negative curvature would spoil the descent */
    if (d->pair_count == PAIR_LIMIT) {         /* forget the oldest */
        double *s = d->pair_s[0], *y = d->pair_y[0];
        for (int k = 1; k < PAIR_LIMIT; k++) {
            d->pair_s[k - 1] = d->pair_s[k];
            d->pair_y[k - 1] = d->pair_y[k];
            d->pair_rho[k - 1] = d->pair_rho[k];
        }
        d->pair_s[PAIR_LIMIT - 1] = s;
        d->pair_y[PAIR_LIMIT - 1] = y;
        d->pair_count--;
    }
    int k = d->pair_count++;
    if (!d->pair_s[k]) d->pair_s[k] = NEW_ARRAY(double, n);
    if (!d->pair_y[k]) d->pair_y[k] = NEW_ARRAY(double, n);
    for (int64_t i = 0; i < n; i++) {
        d->pair_s[k][i] = d->z[i] - d->z_new[i];
        d->pair_y[k][i] = d->g[i] - d->g_new[i];
    }
    d->pair_rho[k] = 1 / sy;
}

/* Is another step with the old factor the cheaper way? In solves, from counts alone, so that the choice does
 * not depend on the clock: the rate seen since the factorisation, against a factorisation and a few steps. */
bool direct_reusable(const descent *d)
{
    if (!d->has_factor || !d->params->reuse_factor) return false;
    if (d->touching && contact_stiffness_is_old(d->t->touch)) return false;
    if (d->since_factor < 2) return true;
    linear_stats s = linear_measure(d->t->l);
    /* nanoseconds on one core: 0.07 per flop of a factorisation; a step is a solve (1.5 per entry) and an
     * energy with forces (500 per tet) */
    double factor = 0.07 * s.factor_flops + 2500.0 * d->t->a.tet_count;
    double step = 1.5 * (double)s.factor_entries + 500.0 * d->t->a.tet_count;
    if (d->touching && d->since_factor > factor / step + 4)
        return false; /* they have cost as much as a factorisation */
    double rate = log(d->residual_at_factor / d->residual) / d->since_factor;
    return rate > 0 && log(d->residual / d->tolerance) / rate < factor / step + 4;
}
