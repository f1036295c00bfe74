/* The iteration of one load: what contact asks for before each step, and when it ends. */
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* What was seen of contact since the iteration began. */
typedef struct contact_watch {
    bool fresh; /* colliders are those of the present iterate */
    int stiffenings, corrections;
} contact_watch;

/* Tets guarded against being crushed. */
typedef struct crush_watch {
    int times, steps; /* that guards were set or stiffened; iterations since the first */
    double *x;        /* [3*nodes] where the first was set; NULL: none was */
} crush_watch;

enum { MOST_CRUSHED = 8, MOST_GUARDED = 80 }; /* times and steps before guards are given up */

typedef enum contact_verdict { CONTACT_GO_ON, CONTACT_LOOK_AGAIN, CONTACT_TOO_DEEP } contact_verdict;

void iterate_refresh(descent *d)
{
    static const double old_mm = 0.01; /* planes that moved farther make a new factor worth while */
    solver *t = d->t;
    double moved = contact_follow(t->touch, t->attach, &t->b, d->here.x);
    if (moved >= 0) {
        boundary_project(&t->b, d->here.x, d->here.z);
        boundary_place(&t->b, d->here.z, d->here.x);
    }
    if (moved > old_mm) direct_forget(&d->direct);
    d->out->contact.slide_off_mm = fmax(0, moved);
    contact_refresh(t->touch, d->here.x);
    point_measure(d);
    d->out->contact.refresh_change_mm = contact_refresh_change(t->touch);
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
    load_state *l = &d->load;
    const contact *c = load_touching(l) ? d->t->touch : NULL;
    if (c)
        l->tolerance_mn =
            fmax(fmax(l->asked_mn, contact_force_noise(c, d->here.x)), l->task.rel_tol * contact_force(c));
    if (c && d->residual > l->tolerance_mn && d->residual < near * l->tolerance_mn)
        l->tolerance_mn = fmax(l->tolerance_mn, point_force_noise(d->t, d->here.x));
    return d->residual <= l->tolerance_mn && !(l->last_step_mm > l->settled_mm);
}

/* Good enough to tell what it lacks? */
static bool is_nearly_solved(descent *d)
{
    return is_solved(d) || d->residual <= d->params->intermediate_rel_tol * d->out->reference_mn;
}

/* Guards against passing through a bone, at an equilibrium good enough to tell. False: none is missing. */
static bool add_guards(descent *d)
{
    if (!d->t->touch->setup.held || d->load.task.load < 1) return false;
    if (!is_nearly_solved(d)) return false;
    if (!contact_guard(d->t->touch, d->here.x)) return false;
    point_measure(d);
    direct_forget(&d->direct);
    return true;
}

/* Colliders are renewed, what is too deep is stiffened, what went through a bone gets a guard. */
static contact_verdict look_at_contact(descent *d, int iteration, contact_watch *w)
{
    contact *c = d->t->touch;
    if (!w->fresh && (is_solved(d) || renews_each_time(c, iteration))) {
        iterate_refresh(d);
        w->fresh = true;
    }
    bool solved = is_solved(d), stiffened = solved && contact_stiffen(c);
    bool corrected = solved && d->load.task.load == 1 && w->corrections < c->setup.params.max_corrections &&
                     contact_correct(c, d->here.x);
    if (stiffened && ++w->stiffenings > c->setup.params.max_stiffenings) return CONTACT_TOO_DEEP;
    if (corrected) w->corrections++;
    if (stiffened || corrected) {
        if (corrected) point_measure(d);
        point_yield(d, &d->here);
        point_measure(d);
        direct_forget(&d->direct);
    }
    if (!w->fresh || !add_guards(d)) return CONTACT_GO_ON;
    w->fresh = false;
    return CONTACT_LOOK_AGAIN;
}

/* Tets that are crushed at the equilibrium of the whole load are guarded: it is none then. */
static bool guard_crushed(descent *d, crush_watch *w)
{
    solver *t = d->t;
    if (d->load.phase != LOAD_WHOLE || d->load.task.load < 1 || w->times == MOST_CRUSHED || !is_nearly_solved(d))
        return false;
    uint8_t *fixed = NEW_ARRAY(uint8_t, t->b.node_count);
    for (size_t v = 0; v < (size_t)t->b.node_count; v++)
        fixed[v] = t->b.unknown[3 * v] < 0 && t->b.unknown[3 * v + 1] < 0 && t->b.unknown[3 * v + 2] < 0;
    bool any = crush_stiffen(&t->crushed, fixed, is_solved(d), d->here.x);
    free(fixed);
    if (!any) return false;
    if (w->times++ == 0) w->x = COPY_ARRAY(double, d->here.x, 3 * (size_t)t->b.node_count);
    point_measure(d);
    direct_forget(&d->direct);
    solver_forget_blocks(t);
    return true;
}

/* Back to where the first guard was set, without any; they stay away. */
static void give_up_guards(descent *d, crush_watch *w)
{
    solver *t = d->t;
    crush_begin(&t->crushed, 0);
    if (load_touching(&d->load)) contact_follow(t->touch, t->attach, &t->b, w->x);
    boundary_project(&t->b, w->x, d->here.z);
    boundary_place(&t->b, d->here.z, d->here.x);
    if (load_touching(&d->load)) contact_refresh(t->touch, d->here.x);
    point_measure(d);
    d->load.last_step_mm = 0;
    direct_forget(&d->direct);
    solver_forget_blocks(t);
}

/* Counts alone, so that the same solve ends at the same iterate on any machine. */
static bool is_out_of_work(const descent *d)
{
    enum { GRADIENTS = 30 }; /* iterations of conjugate gradients that cost as much as a factorisation */
    const linear *l = d->t->l;
    int factorisations = l ? linear_measure(l).factorisations - d->factorisations_before : 0;
    return d->out->iterations + factorisations + d->out->cg_iterations / GRADIENTS > d->params->max_work;
}

/* Does the iteration end before the next step? */
static bool ends(descent *d, int iteration, int max_iterations, solve_outcome *outcome)
{
    if (is_solved(d))
        *outcome = SOLVED;
    else if (iteration > max_iterations)
        *outcome = STOPPED_MAX_ITERATIONS;
    else if (is_out_of_work(d))
        *outcome = STOPPED_MAX_WORK;
    else if (d->params->interrupted && d->params->interrupted(d->params->context))
        *outcome = STOPPED_INTERRUPTED;
    else
        return false;
    return true;
}

static void count(descent *d)
{
    d->out->iterations++;
    if (load_touching(&d->load))
        d->out->contact.contact_iterations++;
    else if (d->load.phase == LOAD_FREE)
        d->out->contact.free_iterations++;
}

static bool run(descent *d, int max_iterations, crush_watch *crushed, solve_outcome *outcome, err *e)
{
    contact_watch watch = {0};
    d->load.energy_noise_uj = assembly_energy_noise(&d->t->a, d->here.x);
    if (d->t->pull) d->load.energy_noise_uj += target_pull_energy_noise(d->t->pull, d->here.x);
    direct_measure_from(&d->direct, d->residual);
    for (int iteration = 1;; iteration++) {
        contact_verdict verdict = load_touching(&d->load) ? look_at_contact(d, iteration, &watch) : CONTACT_GO_ON;
        if (verdict == CONTACT_LOOK_AGAIN) continue;
        if (verdict == CONTACT_TOO_DEEP) {
            *outcome = STOPPED_PENETRATION;
            return true;
        }
        if (guard_crushed(d, crushed)) continue;
        if (ends(d, iteration, max_iterations, outcome)) return true;
        step_taken s = {0};
        bool ok = true;
        if (!step_take(d, &s, &ok, e)) return false;
        if (!ok) {
            *outcome = STOPPED_SINGULAR;
            return true;
        }
        if (!(s.length > 0)) { /* where the residual is low, the last step was as far as rounding lets it go */
            *outcome = d->residual <= d->load.tolerance_mn ? SOLVED : STOPPED_LINE_SEARCH;
            return true;
        }
        watch.fresh = false;
        if (d->load.way == BY_FACTORS && d->params->reuse_factor) direct_remember(d);
        count(d);
        result_record(d, iteration, &s);
        if (crushed->x && ++crushed->steps > MOST_GUARDED) {
            *outcome = STOPPED_MAX_ITERATIONS;
            return true;
        }
    }
}

bool iterate(descent *d, int max_iterations, solve_outcome *outcome, err *e)
{
    crush_watch crushed = {0};
    bool ok = run(d, max_iterations, &crushed, outcome, e);
    if (ok && crushed.x && *outcome != SOLVED && !outcome_is_final(*outcome)) {
        give_up_guards(d, &crushed);
        crush_watch none = {.times = MOST_CRUSHED};
        ok = run(d, max_iterations, &none, outcome, e);
    }
    free(crushed.x);
    return ok;
}
