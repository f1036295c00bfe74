#include "geometry/clock.h"
#include "geometry/mem.h"
#include "sim/motion.h"
#include "sim/src/contact/contact_term.h"
#include "sim/src/elastic/elastic_term.h"
#include "sim/src/solve/descent.h"
#include "sim/src/solve/load_path.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sliding and facing paired nodes become free ones that touch. */
static bool make_contact(solver *t, const equilibrium_problem *problem, err *e)
{
    boundary checked;
    double young = 0;
    if (!boundary_make_drawn(problem->mesh, problem->attach, problem->targets, &checked, e)) return false;
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
    bool ok = (!problem->targets || targets_check(problem->targets, problem->mesh, e)) &&
              elements_make(problem->mesh, problem->materials, problem->material_count, &el, e);
    if (ok && problem->contact) ok = make_contact(t, problem, e);
    ok = ok && boundary_make_drawn(t->mesh, t->attach, problem->targets, &t->b, e) &&
         assembly_make(t->mesh, &el, &t->b, t->touch ? t->touch->coupling : NULL,
                       t->touch ? t->touch->coupling_count : 0, &t->a, e);
    elements_free(&el);
    if (!ok) {
        solver_destroy(&t);
        return false;
    }
    t->crushed.a = &t->a;
    term_add(&t->terms, elastic_term(&t->a));
    term_add(&t->terms, crush_term(&t->crushed));
    if (t->touch) term_add(&t->terms, contact_term(t->touch));
    if (problem->targets) {
        t->pull = target_pull_make(problem->targets, problem->mesh, &t->a);
        term_add(&t->terms, target_term(t->pull));
    }
    t->prepare_s = clock_s() - begin;
    *out = t;
    return true;
}

bool solver_order(solver *t, err *e)
{
    return t->l || linear_create(t->b.unknown_count, t->a.column_start, t->a.row, t->blas_threads, &t->l, e);
}

void solver_forget_blocks(solver *t)
{
    free(t->matrix_x);
    t->matrix_x = NULL;
}

void solver_destroy(solver **t)
{
    if (!*t) return;
    multigrid_destroy(&(*t)->grid);
    blocks_free(&(*t)->k);
    solver_forget_blocks(*t);
    node_blocks_free(&(*t)->f);
    linear_destroy(&(*t)->l);
    target_pull_free(&(*t)->pull);
    contact_destroy(&(*t)->touch);
    attach_map_free(&(*t)->loosened);
    crush_free(&(*t)->crushed);
    assembly_free(&(*t)->a);
    boundary_free(&(*t)->b);
    free(*t);
    *t = NULL;
}

static bool check_motion(const rigid motion[SEGMENT_COUNT], err *e)
{
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        double m[16];
        rigid checked;
        rigid_to_matrix(&motion[s], m);
        if (!rigid_from_matrix(m, &checked, e)) return err_prefix(e, "motion of %s", segment_name((segment_id)s));
    }
    return true;
}

static bool check_start(const solver *t, const double *start_xyz, err *e)
{
    for (size_t i = 0; start_xyz && i < 3 * (size_t)t->b.node_count; i++)
        if (!isfinite(start_xyz[i])) return err_set(e, ERR_INPUT, "start position of node %zu is not finite", i / 3);
    return true;
}

void solver_place(solver *t, const rigid motion[SEGMENT_COUNT])
{
    boundary_move(&t->b, t->mesh, t->attach, motion);
    if (t->touch) contact_move(t->touch, motion, &t->b.guide, t->mesh->xyz);
}

static void move_bones(solver *t, const rigid motion[SEGMENT_COUNT], double load)
{
    rigid part[SEGMENT_COUNT];
    for (int s = 0; s < SEGMENT_COUNT; s++) part[s] = motion_part(&motion[s], load);
    solver_place(t, part);
}

/* The last equilibrium, carried along by the guide; the bones are left at the target. */
static void carry(solver *t, const rigid motion[SEGMENT_COUNT], const load_path *p, const double *reached,
                  double *start)
{
    move_bones(t, motion, p->reached);
    rigid back = rigid_inverse(&t->b.guide);
    bool resting = rigid_is_identity(&t->b.guide);
    move_bones(t, motion, p->target);
    rigid carry = resting ? t->b.guide : rigid_compose(&t->b.guide, &back);
    for (size_t v = 0; v < 3 * (size_t)t->b.node_count; v += 3) rigid_apply(&carry, reached + v, start + v);
}

static load_task task_of(const descent *d, const load_path *p)
{
    bool touches = d->t->touch && load_path_touches(p);
    return (load_task){.load = p->target,
                       .rel_tol = p->target < 1 ? d->params->intermediate_rel_tol : d->params->rel_tol,
                       .touches = touches,
                       .near = touches && p->phase == PATH_GUESS,
                       .free_first = touches && load_path_first_touch(p)};
}

/* Load by load to the whole motion, or as far as it goes. */
static bool follow(descent *d, load_path *p, const rigid motion[SEGMENT_COUNT], const double *start_xyz,
                   solve_outcome *outcome, err *e)
{
    solver *t = d->t;
    size_t n = 3 * (size_t)t->b.node_count;
    double *reached = COPY_ARRAY(double, t->mesh->xyz, n), *start = NEW_ARRAY(double, n);
    bool ok = true;
    while (p->phase != PATH_REACHED && p->phase != PATH_STOPPED) {
        if (p->phase == PATH_GUESS) {
            memcpy(start, start_xyz, n * sizeof *start);
            move_bones(t, motion, p->target);
        } else
            carry(t, motion, p, reached, start);
        load_task task = task_of(d, p);
        d->out->loads++;
        ok = load_run(d, &task, start, outcome, e);
        if (!ok || outcome_is_final(*outcome)) break;
        bool went_on = p->phase == PATH_GUESS && t->goes_on;
        load_path_go_on(p, *outcome == SOLVED);
        if (went_on && p->phase != PATH_REACHED) contact_restart(t->touch);
        if (*outcome == SOLVED) memcpy(reached, d->here.x, n * sizeof *reached);
        if (p->reached == 0) memcpy(reached, t->mesh->xyz, n * sizeof *reached);
    }
    if (p->phase == PATH_STOPPED && p->most_halvings > 0) *outcome = STOPPED_MAX_HALVINGS;
    free(reached);
    free(start);
    return ok;
}

bool solver_solve(solver *t, const rigid motion[SEGMENT_COUNT], const double *start_xyz, const solve_params *params,
                  equilibrium *out, err *e)
{
    if (!solve_params_check(params, e) || !check_motion(motion, e) || !check_start(t, start_xyz, e)) return false;
    double begin = clock_s();
    linear_stats before = t->l ? linear_measure(t->l) : (linear_stats){0};
    equilibrium q = {.node_count = t->b.node_count,
                     .xyz = NEW_ARRAY(double, 3 * (size_t)t->b.node_count),
                     .prepare_s = t->prepare_s};
    descent d;
    descent_make(&d, t, params, &q);
    crush_begin(&t->crushed, params->least_j);
    if (t->touch && t->goes_on) contact_resume(t->touch);
    if (t->touch && !t->goes_on) contact_restart(t->touch);
    if (t->pull) { /* drawn to other places than before, perhaps: of the matrix only the preconditioner will do */
        solver_forget_blocks(t);
        t->factor_kept = t->factor_used = false;
    }
    if (!start_xyz) solver_forget(t); /* what is solved from rest does not depend on plans before */
    load_path path =
        load_path_begin(start_xyz != NULL, t->touch && t->touch->setup.held, params->load_steps, params->max_halvings);
    solve_outcome outcome;
    bool ok = follow(&d, &path, motion, start_xyz, &outcome, e);
    t->factor_kept = ok && outcome == SOLVED && !t->touch && d.load.way == BY_FACTORS && d.direct.has_factor &&
                     d.direct.need == BLEND_NONE;
    q.load_reached = path.reached;
    q.halvings = path.halvings;
    if (ok) {
        result_fill(&d, outcome, &before);
        q.total_s = clock_s() - begin;
        *out = q;
    } else
        equilibrium_free(&q);
    descent_free(&d);
    return ok;
}
