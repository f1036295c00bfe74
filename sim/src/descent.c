#include "sim/src/descent.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/clock.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const double armijo = 1e-4;
static const double blend_least = 1.0 / 256, blend_ratio = 4;
static const double touching_step_mm = 3; /* colliders are renewed after each step */

static double dot(const double *a, const double *b, int64_t n)
{
    double sum = 0;
    for (int64_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static int64_t unknowns(const descent *d)
{
    return d->t->b.unknown_count;
}
static size_t coordinates(const descent *d)
{
    return 3 * (size_t)d->t->b.node_count;
}

void descent_make(descent *d, solver *t, const solve_params *params, equilibrium *out)
{
    size_t n = (size_t)t->b.unknown_count, c = 3 * (size_t)t->b.node_count;
    *d = (descent){.t = t,
                   .params = params,
                   .out = out,
                   .blend = blend_least * blend_ratio * blend_ratio,
                   .z = NEW_ARRAY(double, n),
                   .x = NEW_ARRAY(double, c),
                   .force = NEW_ARRAY(double, c),
                   .g = NEW_ARRAY(double, n),
                   .z_new = NEW_ARRAY(double, n),
                   .x_new = NEW_ARRAY(double, c),
                   .force_new = NEW_ARRAY(double, c),
                   .g_new = NEW_ARRAY(double, n),
                   .direction = NEW_ARRAY(double, n)};
}

void descent_free(descent *d)
{
    double *all[] = {d->z, d->x, d->force, d->g, d->z_new, d->x_new, d->force_new, d->g_new, d->direction};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
    for (int i = 0; i < PAIR_LIMIT; i++) {
        free(d->pair_s[i]);
        free(d->pair_y[i]);
    }
    *d = (descent){0};
}

static double evaluate(descent *d, const double *x, double *force, double *g)
{
    double begin = clock_s(), energy = assembly_energy(&d->t->a, x, force);
    if (d->touching && isfinite(energy)) energy += contact_energy(d->t->touch, x, force);
    boundary_reduce(&d->t->b, force, g);
    d->out->assemble_s += clock_s() - begin;
    return energy;
}

static void swap(double **a, double **b)
{
    double *c = *a;
    *a = *b;
    *b = c;
}

static void accept(descent *d, double energy)
{
    swap(&d->z, &d->z_new);
    swap(&d->x, &d->x_new);
    swap(&d->force, &d->force_new);
    swap(&d->g, &d->g_new);
    d->energy = energy;
    d->residual = sqrt(dot(d->g, d->g, unknowns(d)));
}

static void record(descent *d, int iteration, double step, hessian_kind kind, double factor_s)
{
    equilibrium *q = d->out;
    if ((q->record_count & (q->record_count - 1)) == 0) /* room is the next power of two */
        q->record = GROW_ARRAY(newton_record, q->record, q->record_count ? 2 * (size_t)q->record_count : 1);
    deformation_extremes ex = assembly_extremes(&d->t->a, d->x, false);
    newton_record *r = &q->record[q->record_count++];
    *r = (newton_record){.load = d->load,
                         .iteration = iteration,
                         .residual_mn = d->residual,
                         .tolerance_mn = d->tolerance,
                         .energy_uj = d->energy,
                         .step = step,
                         .hessian = kind,
                         .factor_s = factor_s,
                         .min_j = ex.min_j,
                         .inverted_count = ex.inverted_count,
                         .contact = d->touching};
    if (d->params->progress) d->params->progress(r, d->params->context);
}

static void fill_matrix(descent *d, const double *x, projection how)
{
    assembly *a = &d->t->a;
    double begin = clock_s();
    assembly_stiffness(a, x, how);
    if (d->touching) contact_stiffness(d->t->touch, x, how == PROJECTION_NONE, a);
    assembly_matrix(a, &d->t->b);
    d->out->assemble_s += clock_s() - begin;
}

/* Between the true matrix, which is not positive definite, and the clamped one, which is: the first in a
 * coarse ladder that is. Next to a buckling tissue the clamped matrix is far too stiff along the very mode
 * that wants to move, and residuals crawl; little of it is enough to give that mode a long way down. */
static bool factorise_blend(descent *d, const double *true_value, bool *ok, err *e)
{
    assembly *a = &d->t->a;
    int64_t entries = a->column_start[unknowns(d)];
    double *mixed = NEW_ARRAY(double, entries);
    bool fine = true;
    double part = fmax(d->blend / blend_ratio, blend_least);
    for (; fine && !*ok && part < 1; part *= 2) {
        for (int64_t i = 0; i < entries; i++) mixed[i] = true_value[i] + part * (a->value[i] - true_value[i]);
        fine = linear_factor(d->t->l, mixed, 0, ok, e);
        d->blend = part;
    }
    if (fine && !*ok) d->blend = 1;
    free(mixed);
    return fine;
}

/* Factorises at x, from the wanted kind on towards the safer ones. *kind says what it became; *ok false:
 * none. */
static bool factorise(descent *d, const double *x, hessian_kind *kind, bool *ok, double *seconds, err *e)
{
    assembly *a = &d->t->a;
    double begin = clock_s();
    *ok = false;
    d->pair_count = 0;
    d->has_factor = false;
    if (*kind == HESSIAN_TRUE) {
        fill_matrix(d, x, PROJECTION_NONE);
        if (!linear_factor(d->t->l, a->value, 0, ok, e)) return false;
        if (!*ok) {
            double *true_value = COPY_ARRAY(double, a->value, a->column_start[unknowns(d)]);
            fill_matrix(d, x, d->params->projection);
            *kind = HESSIAN_BLENDED;
            bool fine = factorise_blend(d, true_value, ok, e);
            free(true_value);
            if (!fine) return false;
        }
    } else
        fill_matrix(d, x, d->params->projection);
    if (!*ok && *kind <= HESSIAN_PROJECTED) {
        *kind = HESSIAN_PROJECTED;
        if (!linear_factor(d->t->l, a->value, 0, ok, e)) return false;
    }
    if (!*ok) {
        *kind = HESSIAN_SHIFTED;
        double mean = 0;
        for (int64_t j = 0; j < unknowns(d); j++)
            mean += fabs(a->value[a->column_start[j]]) / (double)unknowns(d);
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
static bool find_direction(descent *d, err *e)
{
    int64_t n = unknowns(d);
    double *q = d->direction, alpha[PAIR_LIMIT];
    memcpy(q, d->g, (size_t)n * sizeof *q);
    for (int k = d->pair_count - 1; k >= 0; k--) {
        alpha[k] = d->pair_rho[k] * dot(d->pair_s[k], q, n);
        for (int64_t i = 0; i < n; i++) q[i] -= alpha[k] * d->pair_y[k][i];
    }
    if (!linear_solve(d->t->l, q, q, e)) return false;
    for (int k = 0; k < d->pair_count; k++) {
        double beta = d->pair_rho[k] * dot(d->pair_y[k], q, n);
        for (int64_t i = 0; i < n; i++) q[i] += (alpha[k] - beta) * d->pair_s[k][i];
    }
    for (int64_t i = 0; i < n; i++) q[i] = -q[i];
    return true;
}

/* After accept(): the old point is in z_new, g_new. */
static void remember_step(descent *d)
{
    int64_t n = unknowns(d);
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

/* Step length along direction, 0 where none is good; then the accepted point is the present one. */
static double line_search(descent *d)
{
    int64_t n = unknowns(d);
    double slope = dot(d->g, d->direction, n), longest = 0;
    if (!(slope < 0)) return 0;
    for (int64_t i = 0; i < n; i++) longest = fmax(longest, fabs(d->direction[i]));
    double limit = d->touching ? fmin(touching_step_mm, d->params->max_step_mm) : d->params->max_step_mm;
    double step = longest > limit ? limit / longest : 1;
    for (int cut = 0; cut <= d->params->max_step_cuts; cut++, step /= 2) {
        for (int64_t i = 0; i < n; i++) d->z_new[i] = d->z[i] + step * d->direction[i];
        boundary_place(&d->t->b, d->z_new, d->x_new);
        double energy = evaluate(d, d->x_new, d->force_new, d->g_new);
        if (!isfinite(energy)) continue;
        bool falls = energy <= d->energy + armijo * step * slope;
        if (!falls && energy <= d->energy + d->energy_noise) /* too near for the energy to tell */
            falls = dot(d->g_new, d->g_new, n) < dot(d->g, d->g, n);
        if (!falls) continue;
        accept(d, energy);
        return step;
    }
    return 0;
}

/* Is another step with the old factor the cheaper way? In solves, from counts alone, so that the choice does
 * not depend on the clock: the rate seen since the factorisation, against a factorisation and a few steps. */
static bool worth_reusing(const descent *d)
{
    if (!d->has_factor || !d->params->reuse_factor) return false;
    if (d->touching && contact_stiffness_is_old(d->t->touch)) return false;
    if (d->since_factor < 2) return true;
    linear_stats s = linear_measure(d->t->l);
    /* nanoseconds on one core: 0.07 per flop of a factorisation; a step is a solve (1.5 per entry) and an
     * energy with forces (500 per tet) */
    double factor = 0.07 * s.factor_flops + 2500.0 * d->t->a.tet_count;
    double step = 1.5 * (double)s.factor_entries + 500.0 * d->t->a.tet_count;
    double rate = log(d->residual_at_factor / d->residual) / d->since_factor;
    return rate > 0 && log(d->residual / d->tolerance) / rate < factor / step + 4;
}

/* Residual of the reference: prescribed nodes moved, free ones carried by the guide only. It sees no common
 * rigid motion, so a turned head is held to the same tolerance. */
static double reference_residual(descent *d)
{
    solver *t = d->t;
    int64_t n = unknowns(d);
    for (int32_t v = 0; v < t->b.node_count; v++) {
        double *p = d->x_new + 3 * (size_t)v;
        if (t->attach->kind[v] == NODE_FREE)
            rigid_apply(&t->b.guide, t->mesh->xyz + 3 * (size_t)v, p);
        else
            vec_copy(t->b.origin + 3 * (size_t)v, p);
    }
    if (isfinite(evaluate(d, d->x_new, d->force_new, d->g_new))) return sqrt(dot(d->g_new, d->g_new, n));
    /* no energy there (a model that forbids inversion): the linear response instead */
    double *carried = NEW_ARRAY(double, coordinates(d));
    for (size_t i = 0; i < coordinates(d); i += 3) {
        rigid_apply(&t->b.guide, t->mesh->xyz + i, carried + i);
        vec_sub(d->x_new + i, carried + i, d->x_new + i);
    }
    assembly_stiffness(&t->a, carried, PROJECTION_NONE);
    free(carried);
    assembly_multiply(&t->a, d->x_new, d->force_new);
    boundary_reduce(&t->b, d->force_new, d->g_new);
    return sqrt(dot(d->g_new, d->g_new, n));
}

/* Adds to z the linear response, about x_start, to carrying the prescribed nodes from x_start to x. */
static bool predict(descent *d, const double *x_start, double *seconds, bool *ok, err *e)
{
    solver *t = d->t;
    int64_t n = unknowns(d);
    hessian_kind kind = HESSIAN_TRUE;
    if (!isfinite(evaluate(d, x_start, d->force_new, d->g_new))) {
        *ok = false;
        return true;
    }
    if (!factorise(d, x_start, &kind, ok, seconds, e)) return false;
    if (!*ok) return true;
    double *carried = d->x_new;
    for (size_t i = 0; i < coordinates(d); i++) carried[i] = d->x[i] - x_start[i];
    assembly_multiply(&t->a, carried, d->force);
    for (size_t i = 0; i < coordinates(d); i++) d->force[i] += d->force_new[i];
    boundary_reduce(&t->b, d->force, d->g_new);
    if (!linear_solve(t->l, d->g_new, d->direction, e)) return false;
    for (int64_t i = 0; i < n; i++) d->z_new[i] = d->z[i] - d->direction[i];
    boundary_place(&t->b, d->z_new, d->x_new);
    double energy = evaluate(d, d->x_new, d->force_new, d->g_new);
    *ok = isfinite(energy);
    if (*ok) accept(d, energy);
    return true;
}

/* Energy, force and residual of the present iterate, as after a change of what counts. */
static void measure(descent *d)
{
    d->energy = evaluate(d, d->x, d->force, d->g);
    d->residual = sqrt(dot(d->g, d->g, unknowns(d)));
}

static void refresh(descent *d)
{
    contact_refresh(d->t->touch, d->x);
    measure(d);
    d->out->contact.refresh_change_mm = contact_refresh_change(d->t->touch);
}

/* Iterates until the residual is below d->tolerance. */
static bool iterate(descent *d, int max_iterations, int *done, solve_outcome *outcome, err *e)
{
    double factor_s;
    bool ok = true, fresh = false;
    int stiffenings = 0;
    d->energy_noise = assembly_energy_noise(&d->t->a, d->x);
    d->residual_at_factor = d->residual;
    for (int iteration = 1;; iteration++) {
        bool low = d->residual <= d->tolerance;
        if (d->touching && !fresh && (low || iteration <= d->t->touch->setup.params.refresh_iterations)) {
            refresh(d);
            fresh = true;
        }
        if (d->residual <= d->tolerance && d->touching && contact_stiffen(d->t->touch)) {
            if (++stiffenings > d->t->touch->setup.params.max_stiffenings) {
                *outcome = STOPPED_PENETRATION;
                return true;
            }
            measure(d);
            d->has_factor = false;
        }
        if (d->residual <= d->tolerance) {
            *outcome = SOLVED;
            return true;
        }
        if (iteration > max_iterations) {
            *outcome = STOPPED_MAX_ITERATIONS;
            return true;
        }
        if (d->params->interrupted && d->params->interrupted(d->params->context)) {
            *outcome = STOPPED_INTERRUPTED;
            return true;
        }
        double step = 0;
        factor_s = 0;
        hessian_kind kind = worth_reusing(d) ? HESSIAN_REUSED : HESSIAN_TRUE;
        for (;;) { /* a direction that leads nowhere is tried again with a safer matrix */
            if (kind != HESSIAN_REUSED) {
                if (!factorise(d, d->x, &kind, &ok, &factor_s, e)) return false;
                if (!ok) {
                    *outcome = STOPPED_SINGULAR;
                    return true;
                }
            }
            if (!find_direction(d, e)) return false;
            step = line_search(d);
            if (step > 0 || kind == HESSIAN_SHIFTED) break;
            kind = kind == HESSIAN_REUSED                            ? HESSIAN_TRUE
                   : kind == HESSIAN_TRUE || kind == HESSIAN_BLENDED ? HESSIAN_PROJECTED
                                                                     : HESSIAN_SHIFTED;
        }
        if (!(step > 0)) {
            *outcome = STOPPED_LINE_SEARCH;
            return true;
        }
        fresh = false;
        d->since_factor++;
        if (d->params->reuse_factor) remember_step(d);
        d->out->iterations++;
        (*done)++;
        record(d, iteration, step, kind, factor_s);
    }
}

/* Phase A: where the tissue would go if nothing touched. Its failure only means a worse start for phase B. */
static bool run_free(descent *d, double reference, bool *interrupted, err *e)
{
    const contact_params *p = &d->t->touch->setup.params;
    double tolerance = d->tolerance;
    solve_outcome outcome;
    d->tolerance = fmax(tolerance, p->free_rel_tol * reference);
    bool ok = iterate(d, p->free_iterations, &d->out->contact.free_iterations, &outcome, e);
    *interrupted = ok && outcome == STOPPED_INTERRUPTED;
    d->tolerance = tolerance;
    return ok;
}

bool descent_run(descent *d, double load, double rel_tol, bool free_first, const double *x_start,
                 solve_outcome *outcome, err *e)
{
    solver *t = d->t;
    d->load = load;
    d->has_factor = false;
    d->pair_count = 0;
    d->touching = false;
    double reference = reference_residual(d), factor_s = 0;
    double floor = assembly_force_noise(&t->a, t->mesh->xyz);
    boundary_project(&t->b, x_start, d->z);
    boundary_place(&t->b, d->z, d->x);
    floor = fmax(floor, assembly_force_noise(&t->a, d->x));
    d->tolerance = fmax(rel_tol * reference, floor);
    d->out->reference_mn = reference;
    if (t->touch) {
        d->touching = true;
        contact_refresh(t->touch, d->x);
    }
    measure(d);
    bool rest = isfinite(d->energy) && d->residual <= d->tolerance, ok = true, interrupted = false;
    if (!rest && t->touch) {
        d->touching = false;
        measure(d);
    }
    if (!rest && d->params->predictor == PREDICT_ELASTIC && !predict(d, x_start, &factor_s, &ok, e))
        return false;
    record(d, 0, 0, HESSIAN_TRUE, factor_s);
    if (!ok || !isfinite(d->energy)) {
        *outcome = STOPPED_NOT_FINITE;
        return true;
    }
    if (!rest && t->touch) {
        if (free_first && !run_free(d, reference, &interrupted, e)) return false;
        if (interrupted) {
            *outcome = STOPPED_INTERRUPTED;
            return true;
        }
        d->touching = true;
        d->has_factor = false;
        d->pair_count = 0;
        refresh(d);
    }
    int counted = 0, *done = d->touching ? &d->out->contact.contact_iterations : &counted;
    return iterate(d, d->params->max_iterations, done, outcome, e);
}
