#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/motion.h"
#include "geometry/clock.h"
#include "sim/src/solve/descent.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

const char *solve_outcome_text(solve_outcome outcome)
{
    switch (outcome) {
    case SOLVED: return "solved";
    case STOPPED_MAX_ITERATIONS: return "stopped: too many iterations";
    case STOPPED_LINE_SEARCH: return "stopped: no step lowers the energy";
    case STOPPED_NOT_FINITE: return "stopped: a tet is inverted in a material that forbids it";
    case STOPPED_SINGULAR: return "stopped: the stiffness matrix cannot be made positive definite";
    case STOPPED_MAX_HALVINGS: return "stopped: the load step became too small";
    case STOPPED_PENETRATION: return "stopped: tissue stays too deep in what it touches";
    case STOPPED_INTERRUPTED: return "interrupted";
    }
    assert(0);
    return "";
}

solve_params solve_params_default(void)
{
    return (solve_params){.load_steps = 1,
                          .max_halvings = 8,
                          .max_iterations = 120,
                          .max_step_cuts = 20,
                          .rel_tol = 1e-8,
                          .intermediate_rel_tol = 1e-4,
                          .max_step_mm = 30,
                          .predictor = PREDICT_ELASTIC,
                          .projection = PROJECTION_CLAMP,
                          .reuse_factor = true,
                          .blas_threads = 1};
}

static bool check_params(const solve_params *p, err *e)
{
    if (p->load_steps < 1) return err_set(e, ERR_INPUT, "load_steps must be >= 1, got %d", p->load_steps);
    if (p->max_halvings < 0) return err_set(e, ERR_INPUT, "max_halvings must be >= 0, got %d", p->max_halvings);
    if (p->max_iterations < 0) return err_set(e, ERR_INPUT, "max_iterations must be >= 0, got %d", p->max_iterations);
    if (p->max_step_cuts < 0) return err_set(e, ERR_INPUT, "max_step_cuts must be >= 0, got %d", p->max_step_cuts);
    if (!(p->rel_tol > 0 && p->rel_tol < 1))
        return err_set(e, ERR_INPUT, "rel_tol must lie between 0 and 1, got %g", p->rel_tol);
    if (!(p->intermediate_rel_tol > 0 && p->intermediate_rel_tol < 1))
        return err_set(e, ERR_INPUT, "intermediate_rel_tol must lie between 0 and 1, got %g", p->intermediate_rel_tol);
    if (!(p->max_step_mm > 0)) return err_set(e, ERR_INPUT, "max_step_mm must be > 0, got %g", p->max_step_mm);
    if (p->projection != PROJECTION_CLAMP && p->projection != PROJECTION_ABS)
        return err_set(e, ERR_INPUT, "projection must be clamp or abs");
    if (p->linear != LINEAR_AUTO && p->linear != LINEAR_FACTOR && p->linear != LINEAR_GRADIENTS)
        return err_set(e, ERR_INPUT, "linear must be auto, factor or gradients");
    if (p->blas_threads < 1) return err_set(e, ERR_INPUT, "blas_threads must be >= 1, got %d", p->blas_threads);
    return true;
}

/* Sliding and facing paired nodes become free ones that touch. */
static bool make_contact(solver *t, const equilibrium_problem *problem, err *e)
{
    boundary checked;
    double young = 0;
    if (!boundary_make(problem->mesh, problem->attach, &checked, e)) return false;
    boundary_free(&checked);
    for (int32_t i = 0; i < problem->material_count; i++) young = fmax(young, problem->materials[i].material.young_kpa);
    if (!contact_make(problem->mesh, problem->attach, problem->contact, young, &t->touch, e)) return false;
    if (problem->contact->held) return true;
    t->loosened = contact_loosened(problem->attach, problem->contact);
    t->attach = &t->loosened;
    return true;
}

bool solver_create(const equilibrium_problem *problem, int blas_threads, solver **out, err *e)
{
    double begin = clock_s();
    if (blas_threads < 1) return err_set(e, ERR_INPUT, "blas_threads must be >= 1, got %d", blas_threads);
    elements el = {0};
    solver *t = NEW_ARRAY(solver, 1);
    t->mesh = problem->mesh;
    t->attach = problem->attach;
    t->blas_threads = blas_threads;
    bool ok = elements_make(problem->mesh, problem->materials, problem->material_count, &el, e);
    if (ok && problem->contact) ok = make_contact(t, problem, e);
    ok = ok && boundary_make(t->mesh, t->attach, &t->b, e) &&
         assembly_make(t->mesh, &el, &t->b, t->touch ? t->touch->coupling : NULL,
                       t->touch ? t->touch->coupling_count : 0, &t->a, e);
    elements_free(&el);
    if (!ok) {
        solver_destroy(&t);
        return false;
    }
    t->prepare_s = clock_s() - begin;
    *out = t;
    return true;
}

bool solver_order(solver *t, err *e)
{
    return t->l || linear_create(t->b.unknown_count, t->a.column_start, t->a.row, t->blas_threads, &t->l, e);
}

void solver_destroy(solver **t)
{
    if (!*t) return;
    multigrid_destroy(&(*t)->grid);
    blocks_free(&(*t)->k);
    free((*t)->matrix_x);
    node_blocks_free(&(*t)->f);
    linear_destroy(&(*t)->l);
    contact_destroy(&(*t)->touch);
    attach_map_free(&(*t)->loosened);
    assembly_free(&(*t)->a);
    boundary_free(&(*t)->b);
    free(*t);
    *t = NULL;
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

static void move_bones(solver *t, const rigid motion[SEGMENT_COUNT], double load)
{
    rigid part[SEGMENT_COUNT];
    for (int s = 0; s < SEGMENT_COUNT; s++) part[s] = motion_part(&motion[s], load);
    boundary_move(&t->b, t->mesh, t->attach, part);
    if (t->touch) contact_move(t->touch, part, &t->b.guide, t->mesh->xyz);
}

bool solver_solve(solver *t, const rigid motion[SEGMENT_COUNT], const double *start_xyz, const solve_params *params,
                  equilibrium *out, err *e)
{
    if (!check_params(params, e)) return false;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        double m[16];
        rigid checked;
        rigid_to_matrix(&motion[s], m);
        if (!rigid_from_matrix(m, &checked, e)) return err_prefix(e, "motion of %s", segment_name((segment_id)s));
    }
    double begin = clock_s();
    size_t n = 3 * (size_t)t->b.node_count;
    for (size_t i = 0; start_xyz && i < n; i++)
        if (!isfinite(start_xyz[i])) return err_set(e, ERR_INPUT, "start position of node %zu is not finite", i / 3);
    linear_stats before = t->l ? linear_measure(t->l) : (linear_stats){0};
    equilibrium q = {.node_count = t->b.node_count, .xyz = NEW_ARRAY(double, n), .prepare_s = t->prepare_s};
    double *at_load = COPY_ARRAY(double, t->mesh->xyz, n), *start = NEW_ARRAY(double, n);
    descent d;
    descent_make(&d, t, params, &q);
    if (t->touch) contact_restart(t->touch);
    if (!start_xyz) { /* what is solved from rest does not depend on plans before */
        multigrid_destroy(&t->grid);
        free(t->matrix_x);
        t->matrix_x = NULL;
    }
    bool ok = true, from_guess = start_xyz != NULL;
    int eased = 0;
    double step = 1.0 / params->load_steps;
    solve_outcome outcome = STOPPED_MAX_ITERATIONS;
    while (q.load_reached < 1) {
        double target = q.load_reached + step;
        if (from_guess || target > 1 - 1e-9) target = 1;
        if (from_guess) {
            memcpy(start, start_xyz, n * sizeof *start);
            move_bones(t, motion, target);
        } else { /* the last equilibrium, carried along by the guide */
            move_bones(t, motion, q.load_reached);
            rigid back = rigid_inverse(&t->b.guide), carry;
            bool resting = rigid_is_identity(&t->b.guide);
            move_bones(t, motion, target);
            carry = resting ? t->b.guide : rigid_compose(&t->b.guide, &back);
            for (size_t v = 0; v < n; v += 3) rigid_apply(&carry, at_load + v, start + v);
        }
        q.loads++;
        double rel_tol = target < 1 ? params->intermediate_rel_tol : params->rel_tol;
        bool loose = t->touch && (t->touch->setup.held && !d.touch_on_the_way ? target >= 1 : q.load_reached == 0) &&
                     !from_guess;
        ok = descent_run(&d, target, rel_tol, loose, from_guess && t->touch, start, &outcome, e);
        if (!ok || outcome == STOPPED_INTERRUPTED) break;
        if (outcome == SOLVED) {
            q.load_reached = target;
            memcpy(at_load, d.x, n * sizeof *at_load);
            if (++eased >= 2) step = fmin(2 * step, 1.0 / params->load_steps);
        } else if (t->touch && t->touch->setup.held && !d.touch_on_the_way && params->max_halvings > 0) {
            d.touch_on_the_way = true; /* contact that comes at the end is too much: feel it from the start */
            q.halvings++;
            q.load_reached = 0;
            memcpy(at_load, t->mesh->xyz, n * sizeof *at_load);
        } else if (from_guess && params->max_halvings > 0) {
            q.halvings++; /* the guess led nowhere: take the way from rest */
        } else if (q.halvings < params->max_halvings) {
            q.halvings++;
            eased = 0;
            step = (target - q.load_reached) / 2;
        } else {
            if (params->max_halvings > 0) outcome = STOPPED_MAX_HALVINGS;
            break;
        }
        from_guess = false;
    }
    if (ok) {
        memcpy(q.xyz, d.x, n * sizeof *q.xyz);
        q.outcome = outcome;
        q.energy_uj = d.energy;
        q.residual_mn = d.residual;
        q.tolerance_mn = d.tolerance;
        q.extremes = assembly_extremes(&t->a, q.xyz, true);
        if (t->touch) {
            memcpy(start, d.x, n * sizeof *start);
            q.energy_uj = assembly_energy(&t->a, start, d.force) + contact_energy(t->touch, start, d.force);
            int a = q.contact.free_iterations, b = q.contact.contact_iterations;
            double change = q.contact.refresh_change_mm;
            q.contact = contact_measure(t->touch);
            q.contact.free_iterations = a;
            q.contact.contact_iterations = b;
            q.contact.refresh_change_mm = change;
            q.contact.passed = contact_passed(t->touch, q.xyz);
        }
        find_reactions(t, d.force, &q);
        q.unknown_count = t->b.unknown_count;
        if (t->l) {
            linear_stats s = linear_measure(t->l);
            q.factorisations = s.factorisations - before.factorisations;
            q.prepare_s += s.analyse_s - before.analyse_s;
            q.factor_s = s.factor_s - before.factor_s;
            q.solve_s += s.solve_s - before.solve_s;
            q.factor_entries = s.factor_entries;
            q.factor_flops = s.factor_flops;
            q.memory_peak_mb = s.memory_peak_mb;
        }
        q.matrix_entries = t->a.column_start[t->b.unknown_count];
        if (t->grid) q.memory_peak_mb += multigrid_mb(t->grid);
        q.total_s = clock_s() - begin;
        *out = q;
    } else
        equilibrium_free(&q);
    descent_free(&d);
    free(at_load);
    free(start);
    return ok;
}

bool equilibrium_solve(const equilibrium_problem *problem, const solve_params *params, equilibrium *out, err *e)
{
    solver *t = NULL;
    if (!check_params(params, e) || !solver_create(problem, params->blas_threads, &t, e)) return false;
    bool ok = solver_solve(t, problem->motion, problem->start_xyz, params, out, e);
    if (ok) out->total_s += t->prepare_s;
    solver_destroy(&t);
    return ok;
}

void equilibrium_free(equilibrium *q)
{
    free(q->xyz);
    free(q->record);
    *q = (equilibrium){0};
}
