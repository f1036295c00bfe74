/* Directions by factorised matrices, and what to factorise. */
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double least_part = 1.0 / 64; /* below, the true matrix itself is tried */

direct_state direct_begin(void) { return (direct_state){.blend = 1.0 / 16}; }

void direct_free(direct_state *m)
{
    for (int i = 0; i < PAIR_LIMIT; i++) {
        free(m->pair_s[i]);
        free(m->pair_y[i]);
    }
    *m = (direct_state){0};
}

void direct_forget(direct_state *m)
{
    m->has_factor = false;
    m->pair_count = 0;
}

void direct_begin_load(direct_state *m)
{
    direct_forget(m);
    m->need = BLEND_NONE;
}

void direct_adopt(direct_state *m, double residual)
{
    m->has_factor = true;
    m->since_factor = 0;
    m->residual_at_factor = residual;
}

void direct_expect_deep(direct_state *m)
{
    m->blend = 1;
    m->need = BLEND_LADDER;
}

void direct_measure_from(direct_state *m, double residual) { m->residual_at_factor = residual; }

double direct_first_rung(const direct_state *m)
{
    static const double least = 1.0 / 256, below = 4; /* the last one used may be more than is needed now */
    return fmax(m->blend / below, least);
}

void direct_fill(descent *d, const double *x, projection how)
{
    assembly *a = &d->t->a;
    double begin = clock_s();
    bool touching = load_touching(&d->load);
    solver_forget_blocks(d->t);
    if (d->load.way == BY_GRADIENTS && !touching && how == PROJECTION_NONE)
        d->t->matrix_x = COPY_ARRAY(double, x, 3 * (size_t)a->node_count);
    term_stiffness(&d->t->terms, touching, x, touching ? d->here.force : NULL, how, a);
    assembly_matrix(a, &d->t->b);
    d->out->assemble_s += clock_s() - begin;
}

/* Each rung of the ladder is so many times the one before. */
static double rung(const descent *d) { return load_touching(&d->load) ? 4 : 2; }

/* What the last matrix needed tells where to begin: there, where it took several tries, and lower where the
 * first was enough, down to the true matrix. */
static double first_part(const descent *d)
{
    if (!load_touching(&d->load) || d->direct.need == BLEND_NONE) return 0;
    return d->direct.need == BLEND_LADDER ? d->direct.blend : d->direct.blend / rung(d);
}

/* Between the true matrix, which is not positive definite, and the clamped one, which is: the first in a
 * coarse ladder that is. Next to a buckling tissue the clamped matrix is far too stiff along the very mode
 * that wants to move, and residuals crawl; little of it is enough to give that mode a long way down.
 * Returns how many rungs were tried in *tries; leaves the clamped matrix in the assembly. */
static bool climb(descent *d, const double *x, double part, int *tries, bool *ok, err *e)
{
    assembly *a = &d->t->a;
    int64_t entries = a->column_start[d->t->b.unknown_count];
    double *true_value = COPY_ARRAY(double, a->value, entries), *mixed = NEW_ARRAY(double, entries);
    bool fine = true;
    direct_fill(d, x, d->params->projection);
    for (*tries = 0; fine && !*ok && part < 1; part *= rung(d), ++*tries) {
        for (int64_t i = 0; i < entries; i++) mixed[i] = true_value[i] + part * (a->value[i] - true_value[i]);
        fine = linear_factor(d->t->l, mixed, 0, ok, e);
        d->direct.blend = part;
    }
    if (fine && !*ok) d->direct.blend = 1;
    free(true_value);
    free(mixed);
    return fine;
}

/* From this part of the clamped matrix on, the true one itself first where that is next to nothing. */
static bool factorise_blended(descent *d, const double *x, double part, hessian_kind *kind, bool *ok, err *e)
{
    bool from_true = part < least_part;
    int tries;
    direct_fill(d, x, PROJECTION_NONE);
    d->direct.need = BLEND_NONE;
    if (from_true && !linear_factor(d->t->l, d->t->a.value, 0, ok, e)) return false;
    if (*ok) return true;
    *kind = HESSIAN_BLENDED;
    if (!climb(d, x, from_true ? direct_first_rung(&d->direct) : part, &tries, ok, e)) return false;
    d->direct.need = from_true || tries > 1 ? BLEND_LADDER : BLEND_FIRST;
    return true;
}

static bool factorise_shifted(descent *d, bool *ok, err *e)
{
    const assembly *a = &d->t->a;
    double mean = 0;
    for (int64_t j = 0; j < d->t->b.unknown_count; j++)
        mean += fabs(a->value[a->column_start[j]]) / (double)d->t->b.unknown_count;
    for (double shift = 1e-3; !*ok && shift < 1e3; shift *= 10)
        if (!linear_factor(d->t->l, a->value, shift * mean, ok, e)) return false;
    return true;
}

bool direct_factorise(descent *d, const double *x, hessian_kind *kind, bool *ok, double *seconds, err *e)
{
    double begin = clock_s(), part = first_part(d);
    *ok = false;
    direct_forget(&d->direct);
    if (!solver_order(d->t, e)) return false;
    if (*kind == HESSIAN_TRUE && part < 1) {
        if (!factorise_blended(d, x, part, kind, ok, e)) return false;
    } else {
        direct_fill(d, x, d->params->projection);
        d->direct.blend = 1;
        d->direct.need = BLEND_FIRST;
    }
    if (!*ok && *kind != HESSIAN_SHIFTED) {
        *kind = HESSIAN_PROJECTED;
        if (!linear_factor(d->t->l, d->t->a.value, 0, ok, e)) return false;
    }
    if (!*ok) {
        *kind = HESSIAN_SHIFTED;
        if (!factorise_shifted(d, ok, e)) return false;
    }
    d->direct.has_factor = *ok;
    d->direct.since_factor = 0;
    d->direct.residual_at_factor = d->residual;
    *seconds += clock_s() - begin;
    return true;
}

/* direction = -(inverse Hessian) g; two-loop recursion, Nocedal & Wright 2006, algorithm 7.4. */
bool direct_direction(descent *d, err *e)
{
    int64_t n = d->t->b.unknown_count;
    double *q = d->direction, alpha[PAIR_LIMIT];
    memcpy(q, d->here.g, (size_t)n * sizeof *q);
    for (int k = d->direct.pair_count - 1; k >= 0; k--) {
        alpha[k] = d->direct.pair_rho[k] * point_dot(d->direct.pair_s[k], q, n);
        for (int64_t i = 0; i < n; i++) q[i] -= alpha[k] * d->direct.pair_y[k][i];
    }
    if (!linear_solve(d->t->l, q, q, e)) return false;
    for (int k = 0; k < d->direct.pair_count; k++) {
        double beta = d->direct.pair_rho[k] * point_dot(d->direct.pair_y[k], q, n);
        for (int64_t i = 0; i < n; i++) q[i] += (alpha[k] - beta) * d->direct.pair_s[k][i];
    }
    for (int64_t i = 0; i < n; i++) q[i] = -q[i];
    return true;
}

void direct_remember(descent *d)
{
    int64_t n = d->t->b.unknown_count;
    double sy = 0, yy = 0, ss = 0;
    d->direct.since_factor++;
    for (int64_t i = 0; i < n; i++) {
        double s = d->here.z[i] - d->trial.z[i], y = d->here.g[i] - d->trial.g[i];
        sy += s * y;
        yy += y * y;
        ss += s * s;
    }
    if (!(sy > 1e-10 * sqrt(ss * yy))) return; /* negative curvature would spoil the descent */
    if (d->direct.pair_count == PAIR_LIMIT) {  /* forget the oldest */
        double *s = d->direct.pair_s[0], *y = d->direct.pair_y[0];
        for (int k = 1; k < PAIR_LIMIT; k++) {
            d->direct.pair_s[k - 1] = d->direct.pair_s[k];
            d->direct.pair_y[k - 1] = d->direct.pair_y[k];
            d->direct.pair_rho[k - 1] = d->direct.pair_rho[k];
        }
        d->direct.pair_s[PAIR_LIMIT - 1] = s;
        d->direct.pair_y[PAIR_LIMIT - 1] = y;
        d->direct.pair_count--;
    }
    int k = d->direct.pair_count++;
    if (!d->direct.pair_s[k]) d->direct.pair_s[k] = NEW_ARRAY(double, n);
    if (!d->direct.pair_y[k]) d->direct.pair_y[k] = NEW_ARRAY(double, n);
    for (int64_t i = 0; i < n; i++) {
        d->direct.pair_s[k][i] = d->here.z[i] - d->trial.z[i];
        d->direct.pair_y[k][i] = d->here.g[i] - d->trial.g[i];
    }
    d->direct.pair_rho[k] = 1 / sy;
}

/* Is another step with the old factor the cheaper way? In solves, from counts alone, so that the choice does
 * not depend on the clock: the rate seen since the factorisation, against a factorisation and a few steps. */
bool direct_reusable(const descent *d)
{
    if (!d->direct.has_factor || !d->params->reuse_factor) return false;
    if (load_touching(&d->load) && contact_stiffness_is_old(d->t->touch)) return false;
    if (d->direct.since_factor < 2) return true;
    linear_stats s = linear_measure(d->t->l);
    /* nanoseconds on one core: 0.07 per flop of a factorisation; a step is a solve (1.5 per entry) and an
     * energy with forces (500 per tet) */
    double factor = 0.07 * s.factor_flops + 2500.0 * d->t->a.tet_count;
    double step = 1.5 * (double)s.factor_entries + 500.0 * d->t->a.tet_count;
    if (load_touching(&d->load) && d->direct.since_factor > factor / step + 4)
        return false; /* they have cost as much as a factorisation */
    double rate = log(d->direct.residual_at_factor / d->residual) / d->direct.since_factor;
    return rate > 0 && log(d->residual / d->load.tolerance_mn) / rate < factor / step + 4;
}
