#include "sim/src/solve/descent.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    GRADIENTS_FROM = 30000, /* unknowns; measured: on irregular meshes below, factors are no slower */
    FACTORS_UP_TO = 400000  /* unknowns: 6 GB */
};

/* Where tissue buckles, gradients crawl, and factors, though each costs n/500 iterations, are the way on. */
static bool have_crawled(const descent *d)
{
    int64_t n = d->t->b.unknown_count;
    return n <= FACTORS_UP_TO && d->cg_at_load > 300 + n / 50;
}

static bool use_gradients(const solver *t, const solve_params *params)
{
    if (params->linear == LINEAR_AUTO) return t->b.unknown_count >= GRADIENTS_FROM;
    return params->linear == LINEAR_GRADIENTS;
}

void descent_make(descent *d, solver *t, const solve_params *params, equilibrium *out)
{
    size_t n = (size_t)t->b.unknown_count, c = 3 * (size_t)t->b.node_count;
    *d = (descent){.t = t,
                   .params = params,
                   .out = out,
                   .inexact = use_gradients(t, params),
                   .blend = 1.0 / 16,
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

static void refresh(descent *d)
{
    static const double old_mm = 0.01; /* planes that moved farther make a new factor worth while */
    solver *t = d->t;
    double moved = contact_follow(t->touch, t->attach, &t->b, d->x);
    if (moved > 0) {
        boundary_project(&t->b, d->x, d->z);
        boundary_place(&t->b, d->z, d->x);
    }
    if (moved > old_mm) {
        d->has_factor = false;
        d->pair_count = 0;
    }
    d->out->contact.slide_off_mm = moved;
    contact_refresh(t->touch, d->x);
    point_measure(d);
    d->out->contact.refresh_change_mm = contact_refresh_change(d->t->touch);
}

/* A direction that leads nowhere is tried again with a safer matrix, conjugate gradients that get nowhere
 * with factors from here on. *ok false: there is no matrix to step with; *step 0: no step is good. */
static bool take_step(descent *d, double *step, hessian_kind *kind, int *cg, double *factor_s, bool *ok, err *e)
{
    d->inexact = d->inexact && !have_crawled(d);
    *kind = !d->inexact && direct_reusable(d) ? HESSIAN_REUSED : HESSIAN_TRUE;
    for (;;) {
        if (d->inexact) {
            if (!inexact_direction(d, kind, cg, ok, factor_s, e)) return false;
            *step = *ok ? point_line_search(d) : 0;
            d->cut = *step < 1;
            if (*step > 0) return true;
            d->inexact = *ok && *kind == HESSIAN_TRUE;
            *kind = d->inexact ? HESSIAN_PROJECTED : HESSIAN_TRUE;
            if (!d->inexact && d->t->b.unknown_count > FACTORS_UP_TO) {
                *ok = false;
                return true;
            }
            continue;
        }
        *ok = true;
        if (*kind != HESSIAN_REUSED && !direct_factorise(d, d->x, kind, ok, factor_s, e)) return false;
        if (!*ok) return true;
        if (!direct_direction(d, e)) return false;
        *step = point_line_search(d);
        if (*step > 0 || *kind == HESSIAN_SHIFTED) return true;
        *kind = *kind == HESSIAN_REUSED                             ? HESSIAN_TRUE
                : *kind == HESSIAN_TRUE || *kind == HESSIAN_BLENDED ? HESSIAN_PROJECTED
                                                                    : HESSIAN_SHIFTED;
    }
}

static bool renews_each_time(const contact *c, int iteration)
{
    return c->setup.held || iteration <= c->setup.params.refresh_iterations;
}

/* The residual is low, and not because it is a bad measure. Where bones press on tissue that hangs on none of
 * them, the contact forces are what it is measured by. */
static bool is_solved(descent *d)
{
    static const double near = 100; /* tolerances: what rounding does to the elastic forces is asked from here on */
    const contact *c = d->touching ? d->t->touch : NULL;
    if (c) d->tolerance = fmax(fmax(d->asked, contact_force_noise(c, d->x)), d->rel_tol * contact_force(c));
    if (c && d->residual > d->tolerance && d->residual < near * d->tolerance)
        d->tolerance = fmax(d->tolerance, assembly_force_noise(&d->t->a, d->x));
    return d->residual <= d->tolerance && !(d->last_step > d->settled);
}

/* How far bones move from where the guide would carry them. */
static double bones_move(const solver *t)
{
    double most = t->touch ? t->touch->motion_reach_mm : 0;
    for (int32_t v = 0; v < t->b.node_count; v++) {
        double carried[3];
        if (t->attach->kind[v] == NODE_FREE) continue;
        rigid_apply(&t->b.guide, t->mesh->xyz + 3 * (size_t)v, carried);
        most = fmax(most, vec_distance(carried, t->b.origin + 3 * (size_t)v));
    }
    return most;
}

/* Guards against passing through a bone, at an equilibrium good enough to tell. False: none is missing. */
static bool add_guards(descent *d)
{
    if (!d->touching || !d->t->touch->setup.held || d->load < 1) return false;
    if (!is_solved(d) && d->residual > d->params->intermediate_rel_tol * d->out->reference_mn) return false;
    int32_t count = contact_guard(d->t->touch, d->x);
    if (!count) return false;
    point_measure(d);
    d->has_factor = false;
    return true;
}

/* Iterates until is_solved. */
static bool iterate(descent *d, int max_iterations, int *done, solve_outcome *outcome, err *e)
{
    bool ok = true, fresh = false;
    int stiffenings = 0;
    d->energy_noise = assembly_energy_noise(&d->t->a, d->x);
    d->residual_at_factor = d->residual;
    for (int iteration = 1;; iteration++) {
        bool low = is_solved(d);
        if (d->touching && !fresh && (low || renews_each_time(d->t->touch, iteration))) {
            refresh(d);
            fresh = true;
        }
        if (d->touching && is_solved(d) && contact_stiffen(d->t->touch)) {
            if (++stiffenings > d->t->touch->setup.params.max_stiffenings) {
                *outcome = STOPPED_PENETRATION;
                return true;
            }
            point_yield(d, d->x, d->z);
            point_measure(d);
            d->has_factor = false;
        }
        if (fresh && add_guards(d)) {
            fresh = false;
            continue;
        }
        if (is_solved(d)) {
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
        int cg = 0;
        hessian_kind kind;
        double step = 0, factor_s = 0;
        if (!take_step(d, &step, &kind, &cg, &factor_s, &ok, e)) return false;
        if (!ok) {
            *outcome = STOPPED_SINGULAR;
            return true;
        }
        if (!(step > 0)) { /* where the residual is low, the last step was as far as rounding lets it go */
            *outcome = d->residual <= d->tolerance ? SOLVED : STOPPED_LINE_SEARCH;
            return true;
        }
        fresh = false;
        d->since_factor++;
        if (!d->inexact && d->params->reuse_factor) direct_remember(d);
        d->out->iterations++;
        (*done)++;
        point_record(d, iteration, step, kind, factor_s, cg);
    }
}

/* Phase A: where the tissue would go if nothing touched. Its failure only means a worse start for phase B. */
static bool run_free(descent *d, double reference, bool *interrupted, err *e)
{
    const contact_params *p = &d->t->touch->setup.params;
    double tolerance = d->tolerance, settled = d->settled;
    solve_outcome outcome;
    d->tolerance = fmax(tolerance, p->free_rel_tol * reference);
    d->settled = HUGE_VAL;
    bool ok = iterate(d, p->free_iterations, &d->out->contact.free_iterations, &outcome, e);
    *interrupted = ok && outcome == STOPPED_INTERRUPTED;
    d->tolerance = tolerance;
    d->settled = settled;
    return ok;
}

bool descent_run(descent *d, double load, double rel_tol, bool free_first, bool warm, const double *x_start,
                 solve_outcome *outcome, err *e)
{
    solver *t = d->t;
    d->load = load;
    d->warm = warm;
    d->rel_tol = rel_tol;
    d->has_factor = false;
    d->pair_count = 0;
    d->touching = false;
    d->inexact = use_gradients(t, d->params);
    d->residual_before = 0;
    d->cg_at_load = 0;
    d->blend_tries = 0;
    d->last_step = 0;
    d->cut = false;
    int cg = 0;
    double reference = start_reference(d), factor_s = 0;
    double floor = assembly_force_noise(&t->a, t->mesh->xyz), moved = bones_move(t);
    if (warm) contact_follow(t->touch, t->attach, &t->b, x_start);
    boundary_project(&t->b, x_start, d->z);
    boundary_place(&t->b, d->z, d->x);
    floor = fmax(floor, assembly_force_noise(&t->a, d->x));
    d->tolerance = d->asked = fmax(rel_tol * reference, floor);
    bool on_the_way = load < 1 || rel_tol * reference <= floor;
    d->settled = on_the_way ? HUGE_VAL : sqrt(rel_tol) * moved;
    d->out->reference_mn = reference;
    bool late = t->touch && t->touch->setup.held && !d->touch_on_the_way;
    bool touch = t->touch && !(late && load < 1);
    if (touch) {
        d->touching = true;
        contact_refresh(t->touch, d->x);
    }
    point_measure(d);
    bool rest = isfinite(d->energy) && d->residual <= d->tolerance, ok = true, interrupted = false;
    if (!rest && touch && !warm) {
        d->touching = false;
        point_measure(d);
    }
    /* contact changes the matrix too much from step to step for a preconditioner to last */
    bool factors = d->params->linear == LINEAR_AUTO && t->b.unknown_count <= FACTORS_UP_TO;
    if (d->touching && factors) d->inexact = false;
    if (!rest && d->params->predictor == PREDICT_ELASTIC && !start_predict(d, x_start, &factor_s, &cg, &ok, e))
        return false;
    point_record(d, 0, 0, HESSIAN_TRUE, factor_s, cg);
    if (!ok || !isfinite(d->energy)) {
        *outcome = STOPPED_NOT_FINITE;
        return true;
    }
    if (!rest && touch) {
        if (free_first && !run_free(d, reference, &interrupted, e)) return false;
        if (interrupted) {
            *outcome = STOPPED_INTERRUPTED;
            return true;
        }
        if (!d->touching) { /* the first contacts are deep */
            d->blend = 1;
            d->blend_tries = 2;
        }
        d->touching = true;
        d->has_factor = false;
        d->pair_count = 0;
        if (factors) d->inexact = false;
        refresh(d);
        if (t->touch->setup.held && load == 1 && contact_guard(t->touch, d->x)) point_measure(d);
    }
    int counted = 0, *done = d->touching ? &d->out->contact.contact_iterations : &counted;
    return iterate(d, d->params->max_iterations, done, outcome, e);
}
