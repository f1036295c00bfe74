#include "geometry/mem.h"
#include "geometry/vec.h"
#include "geometry/clock.h"
#include "sim/src/solve/descent.h"

static const double armijo = 1e-4;
static const double touching_step_mm = 3; /* colliders are renewed after each step */

double point_dot(const double *a, const double *b, int64_t n)
{
    double sum = 0;
    for (int64_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

double point_evaluate(descent *d, const double *x, double *force, double *g)
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

void point_accept(descent *d, double energy)
{
    swap(&d->z, &d->z_new);
    swap(&d->x, &d->x_new);
    swap(&d->force, &d->force_new);
    swap(&d->g, &d->g_new);
    d->energy = energy;
    d->residual = sqrt(point_dot(d->g, d->g, d->t->b.unknown_count));
}

void point_measure(descent *d)
{
    d->energy = point_evaluate(d, d->x, d->force, d->g);
    d->residual = sqrt(point_dot(d->g, d->g, d->t->b.unknown_count));
}

void point_record(descent *d, int iteration, double step, hessian_kind kind, double factor_s, int cg_iterations)
{
    equilibrium *q = d->out;
    if ((q->record_count & (q->record_count - 1)) == 0) /* room is the next power of two */
        q->record = GROW_ARRAY(solve_record, q->record, q->record_count ? 2 * (size_t)q->record_count : 1);
    deformation_extremes ex = assembly_extremes(&d->t->a, d->x, false);
    solve_record *r = &q->record[q->record_count++];
    *r = (solve_record){.load = d->load,
                        .iteration = iteration,
                        .residual_mn = d->residual,
                        .tolerance_mn = d->tolerance,
                        .energy_uj = d->energy,
                        .step = step,
                        .hessian = kind,
                        .cg_iterations = cg_iterations,
                        .factor_s = factor_s,
                        .min_j = ex.min_j,
                        .inverted_count = ex.inverted_count,
                        .contact = d->touching};
    if (d->params->progress) d->params->progress(r, d->params->context);
}

double point_yield(descent *d, double *x, double *z)
{
    double farthest = contact_yield(d->t->touch, &d->t->b, z);
    if (!(farthest > 0)) return 0;
    boundary_place(&d->t->b, z, x);
    contact_retract(d->t->touch, d->t->attach, x);
    return farthest;
}

/* Is the trial point low enough after this fraction of the direction? */
static bool falls_enough(const descent *d, double energy, double step, double slope)
{
    int64_t n = d->t->b.unknown_count;
    if (!isfinite(energy)) return false;
    if (energy <= d->energy + armijo * step * slope) return true;
    return energy <= d->energy + d->energy_noise && /* too near for the energy to tell */
           point_dot(d->g_new, d->g_new, n) < point_dot(d->g, d->g, n);
}

/* Energy of the trial point z_new. */
static double try_point(descent *d)
{
    boundary_place(&d->t->b, d->z_new, d->x_new);
    if (d->touching) contact_retract(d->t->touch, d->t->attach, d->x_new);
    return point_evaluate(d, d->x_new, d->force_new, d->g_new);
}

static void set_trial(descent *d, double step)
{
    for (int64_t i = 0; i < d->t->b.unknown_count; i++) d->z_new[i] = d->z[i] + step * d->direction[i];
}

/* The trial point after this fraction of the direction; contacts give way where it would else be too high,
 * and from a near solution wherever that is lower. False: it is no good. */
static bool try_step(descent *d, double step, double slope, double *energy, double *yielded)
{
    set_trial(d, step);
    *energy = try_point(d);
    *yielded = 0;
    bool falls = falls_enough(d, *energy, step, slope);
    if (!d->touching || !isfinite(*energy) || (falls && !d->warm)) return falls;
    *yielded = contact_yield(d->t->touch, &d->t->b, d->z_new);
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
    double slope = point_dot(d->g, d->direction, n), longest = 0, energy, yielded;
    if (!(slope < 0)) return 0;
    for (int64_t i = 0; i < n; i++) longest = fmax(longest, fabs(d->direction[i]));
    if (d->touching) contact_mark(d->t->touch);
    double limit = d->touching ? fmin(touching_step_mm, d->params->max_step_mm) : d->params->max_step_mm;
    double step = longest > limit ? limit / longest : 1;
    for (int cut = 0; cut <= d->params->max_step_cuts; cut++, step /= 2) {
        if (!try_step(d, step, slope, &energy, &yielded)) continue;
        d->residual_before = d->residual;
        d->last_step = fmax(step * longest, yielded);
        point_accept(d, energy);
        return step;
    }
    return 0;
}
