/* Iterates and the line search. */
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stdlib.h>

static const double armijo = 1e-4;
static const double touching_step_mm = 3; /* colliders are renewed after each step */

static point new_point(const solver *t)
{
    size_t n = (size_t)t->b.unknown_count, c = 3 * (size_t)t->b.node_count;
    return (point){NEW_ARRAY(double, n), NEW_ARRAY(double, c), NEW_ARRAY(double, c), NEW_ARRAY(double, n)};
}

static void free_point(point *p)
{
    free(p->z);
    free(p->x);
    free(p->force);
    free(p->g);
}

double point_dot(const double *a, const double *b, int64_t n)
{
    double sum = 0;
    for (int64_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

double point_force_noise(const solver *t, const double *x)
{
    double elastic = assembly_force_noise(&t->a, x);
    return t->pull ? hypot(elastic, target_pull_force_noise(t->pull, x)) : elastic;
}

void descent_make(descent *d, solver *t, const solve_params *params, equilibrium *out)
{
    *d = (descent){.t = t,
                   .params = params,
                   .out = out,
                   .factorisations_before = t->l ? linear_measure(t->l).factorisations : 0,
                   .here = new_point(t),
                   .trial = new_point(t),
                   .direction = NEW_ARRAY(double, t->b.unknown_count),
                   .direct = direct_begin()};
}

void descent_free(descent *d)
{
    free_point(&d->here);
    free_point(&d->trial);
    free(d->direction);
    direct_free(&d->direct);
    *d = (descent){0};
}

double point_evaluate(descent *d, bool touching, const double *x, point *p)
{
    double begin = clock_s(), energy = term_energy(&d->t->terms, touching, x, p->force);
    boundary_reduce(&d->t->b, p->force, p->g);
    d->out->assemble_s += clock_s() - begin;
    return energy;
}

static void set_energy(descent *d, double energy)
{
    d->energy = energy;
    d->residual = sqrt(point_dot(d->here.g, d->here.g, d->t->b.unknown_count));
}

void point_accept(descent *d, double energy)
{
    point old = d->here;
    d->here = d->trial;
    d->trial = old;
    set_energy(d, energy);
}

void point_measure(descent *d) { set_energy(d, point_evaluate(d, load_touching(&d->load), d->here.x, &d->here)); }

double point_yield(descent *d, point *p)
{
    double farthest = contact_yield(d->t->touch, &d->t->b, p->z);
    if (!(farthest > 0)) return 0;
    boundary_place(&d->t->b, p->z, p->x);
    contact_retract(d->t->touch, d->t->attach, p->x);
    return farthest;
}

/* Is the trial point low enough after this fraction of the direction? */
static bool falls_enough(const descent *d, double energy, double step, double slope)
{
    int64_t n = d->t->b.unknown_count;
    if (!isfinite(energy)) return false;
    if (energy <= d->energy + armijo * step * slope) return true;
    return energy <= d->energy + d->load.energy_noise_uj && /* too near for the energy to tell */
           point_dot(d->trial.g, d->trial.g, n) < point_dot(d->here.g, d->here.g, n);
}

/* Energy of the trial point, placed from its unknowns. */
static double try_point(descent *d)
{
    boundary_place(&d->t->b, d->trial.z, d->trial.x);
    if (load_touching(&d->load)) contact_retract(d->t->touch, d->t->attach, d->trial.x);
    return point_evaluate(d, load_touching(&d->load), d->trial.x, &d->trial);
}

static void set_trial(descent *d, double step)
{
    for (int64_t i = 0; i < d->t->b.unknown_count; i++) d->trial.z[i] = d->here.z[i] + step * d->direction[i];
}

/* The trial point after this fraction of the direction; contacts give way where it would else be too high,
 * and from a near solution wherever that is lower. False: it is no good. */
static bool try_step(descent *d, double step, double slope, double *energy, double *yielded)
{
    set_trial(d, step);
    *energy = try_point(d);
    *yielded = 0;
    bool falls = falls_enough(d, *energy, step, slope);
    if (!load_touching(&d->load) || !isfinite(*energy) || (falls && !d->load.task.near)) return falls;
    *yielded = contact_yield(d->t->touch, &d->t->b, d->trial.z);
    if (!(*yielded > 0)) return falls;
    double before = *energy;
    *energy = try_point(d);
    if (falls_enough(d, *energy, step, slope) && (!falls || *energy < before)) return true;
    if (!falls) return false;
    *yielded = 0;
    set_trial(d, step);
    *energy = try_point(d);
    return true;
}

double point_line_search(descent *d)
{
    int64_t n = d->t->b.unknown_count;
    double slope = point_dot(d->here.g, d->direction, n), longest = 0, energy, yielded;
    if (!(slope < 0)) return 0;
    for (int64_t i = 0; i < n; i++) longest = fmax(longest, fabs(d->direction[i]));
    if (load_touching(&d->load)) contact_mark(d->t->touch);
    double limit = load_touching(&d->load) ? fmin(touching_step_mm, d->params->max_step_mm) : d->params->max_step_mm;
    double step = longest > limit ? limit / longest : 1;
    for (int cut = 0; cut <= d->params->max_step_cuts; cut++, step /= 2) {
        if (!try_step(d, step, slope, &energy, &yielded)) continue;
        d->load.residual_before = d->residual;
        d->load.last_step_mm = fmax(step * longest, yielded);
        point_accept(d, energy);
        return step;
    }
    return 0;
}
