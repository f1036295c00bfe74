/* The next plan from the last one: to first order where the tissue goes as the bones go on, then the solve. */
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void solver_forget(solver *t)
{
    multigrid_destroy(&t->grid);
    solver_forget_blocks(t);
    t->factor_kept = false;
}

void solver_inherit(solver *t, const solver *before)
{
    if (t->touch && before->touch) contact_inherit(t->touch, before->touch);
}

/* Bones that go on by `on` carry the nodes that hang on them; carried[3*nodes]. */
static void find_carried(const solver *t, const rigid on[SEGMENT_COUNT], const double *x, double *carried)
{
    for (int32_t v = 0; v < t->b.node_count; v++) {
        double *c = carried + 3 * (size_t)v;
        const double *p = x + 3 * (size_t)v;
        vec_copy(p, c);
        if (t->attach->kind[v] != NODE_FREE) rigid_apply(&on[t->attach->segment[v]], p, c);
        vec_sub(c, p, c);
    }
}

/* d at x, the bones at `from`, with the contacts there. */
static void measure_at(descent *d, const rigid from[SEGMENT_COUNT], const double *x)
{
    solver *t = d->t;
    d->load = (load_state){.task = {.load = 1, .touches = true, .near = true}, .phase = LOAD_WHOLE, .way = BY_FACTORS};
    solver_place(t, from);
    contact_follow(t->touch, t->attach, &t->b, x);
    boundary_project(&t->b, x, d->here.z);
    boundary_place(&t->b, d->here.z, d->here.x);
    contact_refresh(t->touch, d->here.x);
    point_measure(d);
}

/* guess[3*nodes] from the response of tissue and contacts, by the factor at d, to the bones' way from there. */
static bool respond(descent *d, const rigid from[SEGMENT_COUNT], const rigid to[SEGMENT_COUNT], double *guess, err *e)
{
    solver *t = d->t;
    const point *here = &d->here, *work = &d->trial;
    size_t n = 3 * (size_t)t->b.node_count;
    rigid on[SEGMENT_COUNT];
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        rigid back = rigid_inverse(&from[s]);
        on[s] = rigid_compose(&to[s], &back);
    }
    find_carried(t, on, here->x, work->x);
    assembly_stiffness(&t->a, here->x, PROJECTION_NONE);
    assembly_multiply(&t->a, work->x, work->force);
    contact_carry(t->touch, on, here->x, work->x, work->force);
    for (size_t i = 0; i < n; i++) work->force[i] += here->force[i];
    boundary_reduce(&t->b, work->force, work->g);
    if (!linear_solve(t->l, work->g, d->direction, e)) return false;
    for (size_t i = 0; i < n; i++) work->x[i] += here->x[i];
    solver_place(t, to);
    contact_follow(t->touch, t->attach, &t->b, work->x);
    boundary_project(&t->b, work->x, work->z);
    for (int64_t i = 0; i < t->b.unknown_count; i++) work->z[i] -= d->direction[i];
    boundary_place(&t->b, work->z, guess);
    contact_retract(t->touch, t->attach, guess);
    return true;
}

/* guess is x where there is no factor to respond with. */
static bool predict(solver *t, const rigid from[SEGMENT_COUNT], const rigid to[SEGMENT_COUNT], const double *x,
                    const solve_params *params, double *guess, equilibrium *spent, err *e)
{
    descent d;
    hessian_kind kind = HESSIAN_TRUE;
    bool positive = false;
    double seconds = 0;
    descent_make(&d, t, params, spent);
    memcpy(guess, x, 3 * (size_t)t->b.node_count * sizeof *guess);
    measure_at(&d, from, x);
    bool ok = !isfinite(d.energy) || direct_factorise(&d, d.here.x, &kind, &positive, &seconds, e);
    ok = ok && (!positive || respond(&d, from, to, guess, e));
    descent_free(&d);
    return ok;
}

bool solver_follow(solver *t, const rigid from[SEGMENT_COUNT], const rigid to[SEGMENT_COUNT], const double *x,
                   const solve_params *params, equilibrium *out, err *e)
{
    if (!t->touch) {
        t->factor_used = t->factor_kept;
        bool ok = solver_solve(t, to, x, params, out, e);
        t->factor_used = false;
        return ok;
    }
    double *guess = NEW_ARRAY(double, 3 * (size_t)t->b.node_count);
    equilibrium spent = {0};
    int before = t->l ? linear_measure(t->l).factorisations : 0;
    bool ok = predict(t, from, to, x, params, guess, &spent, e);
    int factorisations = t->l ? linear_measure(t->l).factorisations - before : 0;
    t->goes_on = true;
    ok = ok && solver_solve(t, to, guess, params, out, e);
    t->goes_on = false;
    if (ok) {
        out->factorisations += factorisations;
        out->assemble_s += spent.assemble_s;
    }
    free(guess);
    return ok;
}
