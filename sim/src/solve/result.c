/* What a solve tells: a record of each iteration, and of the last iterate what it costs the bones. */
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/solve/descent.h"
#include <string.h>

void result_record(descent *d, int iteration, const step_taken *s)
{
    equilibrium *q = d->out;
    if ((q->record_count & (q->record_count - 1)) == 0) /* room is the next power of two */
        q->record = GROW_ARRAY(solve_record, q->record, q->record_count ? 2 * (size_t)q->record_count : 1);
    deformation_extremes ex = assembly_extremes(&d->t->a, d->here.x, false);
    solve_record *r = &q->record[q->record_count++];
    *r = (solve_record){.load = d->load.task.load,
                        .iteration = iteration,
                        .residual_mn = d->residual,
                        .tolerance_mn = d->load.tolerance_mn,
                        .energy_uj = d->energy,
                        .step = s->length,
                        .hessian = s->kind,
                        .cg_iterations = s->cg_iterations,
                        .factor_s = s->factor_s,
                        .min_j = ex.min_j,
                        .inverted_count = ex.inverted_count,
                        .contact = load_touching(&d->load)};
    if (d->params->progress) d->params->progress(r, d->params->context);
}

/* What each bone does to the tissue, and whether it sums to nothing. */
static void find_reactions(const solver *t, const double *force, equilibrium *q)
{
    double sum[3] = {0}, norms = 0;
    for (int32_t v = 0; v < t->b.node_count; v++) {
        if (t->attach->kind[v] == NODE_FREE) continue;
        const double *f = force + 3 * (size_t)v;
        double held[3];
        vec_copy(f, held);
        if (t->attach->kind[v] == NODE_SLIDING) { /* frictionless: the bone holds along the normal only */
            const double *n = t->b.basis + 9 * (size_t)v;
            vec_scale(n, vec_dot(f, n), held);
        }
        vec_add(q->segment_force_mn[t->attach->segment[v]], held, q->segment_force_mn[t->attach->segment[v]]);
        vec_add(sum, held, sum);
        norms += vec_norm(held);
    }
    for (int s = 0; t->touch && s < SEGMENT_COUNT; s++) {
        const double *f = q->contact.bone_force_mn[s];
        vec_add(q->segment_force_mn[s], f, q->segment_force_mn[s]);
        vec_add(sum, f, sum);
        norms += vec_norm(f);
    }
    q->imbalance = norms > 0 ? vec_norm(sum) / norms : 0;
}

/* Of the last iterate with what touches there; counts that the loads kept stay. */
static void report_contact(const descent *d, equilibrium *q)
{
    contact *c = d->t->touch;
    contact_report kept = q->contact;
    contact_energy(c, d->here.x, NULL); /* the last one may have been of a trial point */
    q->contact = contact_measure(c);
    q->contact.free_iterations = kept.free_iterations;
    q->contact.contact_iterations = kept.contact_iterations;
    q->contact.refresh_change_mm = kept.refresh_change_mm;
    q->contact.slide_off_mm = kept.slide_off_mm;
    q->contact.passed = contact_passed(c, d->here.x);
}

static void count_costs(const solver *t, const linear_stats *before, equilibrium *q)
{
    q->unknown_count = t->b.unknown_count;
    q->matrix_entries = t->a.column_start[t->b.unknown_count];
    if (t->l) {
        linear_stats s = linear_measure(t->l);
        q->factorisations = s.factorisations - before->factorisations;
        q->prepare_s += s.analyse_s - before->analyse_s;
        q->factor_s = s.factor_s - before->factor_s;
        q->solve_s += s.solve_s - before->solve_s;
        q->factor_entries = s.factor_entries;
        q->factor_flops = s.factor_flops;
        q->memory_peak_mb = s.memory_peak_mb;
    }
    if (t->grid) q->memory_peak_mb += multigrid_mb(t->grid);
}

/* Where most of the force is left. */
static int32_t find_stuck(const boundary *b, const double *g)
{
    int32_t worst = -1;
    double most = 0;
    for (int32_t v = 0; v < b->node_count; v++) {
        double square = 0;
        for (size_t k = 0; k < 3; k++) { /* of unknowns, not of nodes: a pair presses its nodes at equilibrium too */
            int32_t unknown = b->unknown[3 * (size_t)v + k];
            if (unknown >= 0) square += g[unknown] * g[unknown];
        }
        if (square > most) {
            most = square;
            worst = v;
        }
    }
    return worst;
}

void result_fill(descent *d, solve_outcome outcome, const linear_stats *before)
{
    solver *t = d->t;
    equilibrium *q = d->out;
    memcpy(q->xyz, d->here.x, 3 * (size_t)q->node_count * sizeof *q->xyz);
    q->outcome = outcome;
    q->residual_mn = d->residual;
    q->tolerance_mn = d->load.tolerance_mn;
    q->extremes = assembly_extremes(&t->a, q->xyz, true);
    q->crushed_tets = t->crushed.count;
    q->energy_uj = term_energy(&t->terms, true, d->here.x, d->here.force);
    if (t->touch) report_contact(d, q);
    q->stuck_node = outcome == SOLVED ? -1 : find_stuck(&t->b, d->here.g);
    find_reactions(t, d->here.force, q);
    count_costs(t, before, q);
}
