#include "sim/registration.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/tet_volume.h"
#include "geometry/vec.h"
#include "sim/solver.h"
#include "sim/src/identity/registration_springs.h"
#include <stdlib.h>
#include <string.h>

static const double young_kpa = 1; /* only its ratio to the springs counts, which are in its measure */
static const double settled_mm = 0.1, settled_last_mm = 2e-3; /* the longest move of a node in a round */
enum { GIVE_MOST = 8, GIVE_STEPS = 4 };                       /* times that springs give way, Newton steps after each */

registration_params registration_params_default(void)
{
    return (registration_params){.poisson = 0.2,
                                 .stages = 5,
                                 .rounds = 4,
                                 .soft_mm = 200,
                                 .stiff_mm = 0.5,
                                 .reach_first_mm = 25,
                                 .reach_mm = 5,
                                 .facing_cos = 0.5,
                                 .across = 0.1,
                                 .min_j = 0.1};
}

static bool check_params(const registration_params *p, err *e)
{
    if (p->stages < 1 || p->rounds < 1)
        return err_set(e, ERR_INPUT, "a registration needs a stage and a round, got %d and %d", p->stages, p->rounds);
    if (!(p->soft_mm > 0 && p->stiff_mm > 0))
        return err_set(e, ERR_INPUT, "soft_mm and stiff_mm must be above 0, got %g and %g", p->soft_mm, p->stiff_mm);
    if (!(p->reach_first_mm > 0 && p->reach_mm > 0))
        return err_set(e, ERR_INPUT, "a reach must be above 0 mm, got %g and %g", p->reach_first_mm, p->reach_mm);
    if (!(p->across > 0 && p->across <= 1))
        return err_set(e, ERR_INPUT, "the share across must be above 0 and at most 1, got %g", p->across);
    if (!(p->min_j >= 0 && p->min_j < 1))
        return err_set(e, ERR_INPUT, "min_j must lie between 0 and 1, got %g", p->min_j);
    return true;
}

typedef struct work {
    const registration_params *params;
    registration_springs springs;
    solver *t;
    double *x; /* [3*nodes] */
    registration *out;
} work;

/* First value, then a constant factor from stage to stage to the last. */
static double of_stage(const registration_params *p, int stage, double first, double last)
{
    return p->stages == 1 ? last : first * pow(last / first, stage / (p->stages - 1.0));
}

/* Springs are aimed and the body goes so many Newton steps towards where they draw it. */
static bool step(work *w, const registration_round *round, int iterations, double *moved, err *e)
{
    rigid still[SEGMENT_COUNT];
    solve_params params = solve_params_default();
    equilibrium q;
    for (int s = 0; s < SEGMENT_COUNT; s++) still[s] = rigid_identity();
    params.max_iterations = iterations;
    params.max_halvings = 0;
    params.rel_tol = 1e-12;
    params.predictor = PREDICT_RIGID;
    params.linear = LINEAR_FACTOR;
    registration_springs_aim(&w->springs, round, w->x);
    if (!solver_solve(w->t, still, w->x, &params, &q, e)) return false;
    w->out->rounds++;
    w->out->iterations += q.iterations;
    w->out->factorisations += q.factorisations;
    w->out->factor_s += q.factor_s;
    *moved = 0;
    for (size_t i = 0; i < 3 * (size_t)q.node_count; i++) *moved = fmax(*moved, fabs(q.xyz[i] - w->x[i]));
    memcpy(w->x, q.xyz, 3 * (size_t)q.node_count * sizeof *w->x);
    solve_outcome outcome = q.outcome;
    equilibrium_free(&q);
    return outcome == SOLVED || outcome == STOPPED_MAX_ITERATIONS || outcome == STOPPED_LINE_SEARCH ||
           err_set(e, ERR_NOT_CONVERGED, "the registration %s", solve_outcome_text(outcome));
}

/* Springs about tets that are too small give way until there are none. */
static bool give_way(work *w, const registration_round *round, err *e)
{
    double moved;
    for (int k = 0; k < GIVE_MOST && registration_springs_give(&w->springs, w->x, w->params->min_j); k++)
        if (!step(w, round, GIVE_STEPS, &moved, e)) return false;
    return true;
}

static bool run_stages(work *w, err *e)
{
    const registration_params *p = w->params;
    for (int stage = 0; stage < p->stages; stage++) {
        bool last = stage == p->stages - 1;
        registration_round round = {.stiffness_kpa_mm = young_kpa / of_stage(p, stage, p->soft_mm, p->stiff_mm),
                                    .rules = {of_stage(p, stage, p->reach_first_mm, p->reach_mm), p->facing_cos},
                                    .across = p->across};
        double moved = HUGE_VAL;
        for (int k = 0; k < p->rounds && moved > (last ? settled_last_mm : settled_mm); k++) {
            if (p->interrupted && p->interrupted(p->context)) return err_set(e, ERR_INTERRUPTED, "interrupted");
            if (!step(w, &round, 1, &moved, e)) return false;
        }
        if (last && !give_way(w, &round, e)) return false;
        if (last) registration_springs_aim(&w->springs, &round, w->x);
    }
    return true;
}

static int by_size(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

registration_gaps registration_gaps_of(double *gap, int32_t count, int32_t vertices)
{
    registration_gaps g = {.vertices = vertices, .with_target = count};
    if (!count) return g;
    for (int32_t i = 0; i < count; i++) g.mean_mm += gap[i];
    g.mean_mm /= count;
    qsort(gap, (size_t)count, sizeof *gap, by_size);
    g.p95_mm = gap[(int64_t)(0.95 * (count - 1))];
    g.max_mm = gap[count - 1];
    return g;
}

static registration_gaps gaps_of(const registration_springs *s, int32_t part)
{
    double *gap = NEW_ARRAY(double, s->t.count);
    int32_t count = 0;
    for (int32_t k = 0; k < s->t.count; k++)
        if (s->part[k] == part && s->gap_mm[k] < HUGE_VAL) gap[count++] = s->gap_mm[k];
    registration_gaps g = registration_gaps_of(gap, count, s->problem->part[part].moving->vertex_count);
    free(gap);
    return g;
}

static bool run(work *w, const registration_problem *problem, err *e)
{
    region_material table = {.region = REGION_ANY};
    attach_map none = attach_map_new(problem->body->vertex_count, 0);
    equilibrium_problem tissue = {
        .mesh = problem->body, .attach = &none, .materials = &table, .material_count = 1, .targets = &w->springs.t};
    bool ok = w->springs.t.count > 0 || err_set(e, ERR_GEOMETRY, "nothing that the body carries is to be drawn");
    ok = ok && material_make(MATERIAL_SNH_LOG, young_kpa, w->params->poisson, &table.material, e) &&
         solver_create(&tissue, 1, &w->t, e) && run_stages(w, e);
    solver_destroy(&w->t);
    attach_map_free(&none);
    return ok;
}

bool registration_run(const registration_problem *problem, const registration_params *params, registration *out, err *e)
{
    double begin = clock_s();
    if (!check_params(params, e)) return false;
    registration r = {.gaps = NEW_ARRAY(registration_gaps, problem->part_count)};
    work w = {.params = params,
              .springs = registration_springs_make(problem),
              .x = COPY_ARRAY(double, problem->start_xyz ? problem->start_xyz : problem->body->xyz,
                              3 * (size_t)problem->body->vertex_count),
              .out = &r};
    bool ok = run(&w, problem, e);
    r.xyz = w.x;
    if (ok) {
        for (int32_t i = 0; i < problem->part_count; i++) r.gaps[i] = gaps_of(&w.springs, i);
        for (int32_t k = 0; k < w.springs.t.count; k++) r.given_way += w.springs.give[k] < 1;
        r.min_j = tets_min_j(problem->body, r.xyz, &r.inverted_tets);
        r.total_s = clock_s() - begin;
        *out = r;
    } else
        registration_free(&r);
    registration_springs_free(&w.springs);
    return ok;
}

void registration_free(registration *r)
{
    free(r->xyz);
    free(r->gaps);
    *r = (registration){0};
}
