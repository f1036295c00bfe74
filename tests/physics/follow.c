/* One solver, plan after plan: what follows from the last plan is what a solve from rest gives, for less. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "sim/src/solve/solver_state.h"
#include "tests/physics/touching.h"

static const double same_mm = 1e-4;

/* The plane, or what the body hangs on, rises by so much. */
static void rise(rigid motion[SEGMENT_COUNT], double mm)
{
    rest_motions(motion);
    motion[SEGMENT_DISTAL] = rigid_translation((double[]){0.2 * mm, 0, mm});
}

static equilibrium from_rest(solver *t, const rigid motion[SEGMENT_COUNT])
{
    solve_params params = solve_params_default();
    equilibrium q;
    err e = {0};
    assert_ok(solver_solve(t, motion, NULL, &params, &q, &e));
    assert_int_equal(q.outcome, SOLVED);
    return q;
}

static equilibrium from_last(solver *t, const rigid from[SEGMENT_COUNT], const rigid to[SEGMENT_COUNT], const double *x)
{
    solve_params params = solve_params_default();
    equilibrium q;
    err e = {0};
    assert_ok(solver_follow(t, from, to, x, &params, &q, &e));
    assert_int_equal(q.outcome, SOLVED);
    return q;
}

static double farthest(const equilibrium *a, const equilibrium *b)
{
    double most = 0;
    for (size_t i = 0; i < 3 * (size_t)a->node_count; i += 3) most = fmax(most, vec_distance(a->xyz + i, b->xyz + i));
    return most;
}

static solver *make(const touching *s)
{
    solver *t;
    err e = {0};
    assert_ok(solver_create(&s->body.problem, 1, &t, &e));
    return t;
}

/* Plane up 2 mm, then on to 2.5: by a solver that goes on, and by one that knows nothing of the first plan. */
static void check_next_plan(touching *s, const char *name)
{
    rigid first[SEGMENT_COUNT], next[SEGMENT_COUNT];
    rise(first, 2);
    rise(next, 2.5);
    solver *t = make(s), *other = make(s);
    equilibrium a = from_rest(t, first), fresh = from_rest(other, next), on = from_last(t, first, next, a.xyz);
    double off = farthest(&on, &fresh), way = farthest(&a, &fresh);
    printf("%s: %d iterations, %d factorisations from rest, %d, %d from the last plan; %.1e mm apart of %.2f\n", name,
           fresh.iterations, fresh.factorisations, on.iterations, on.factorisations, off, way);
    assert_true(way > 0.2 && off < same_mm);
    assert_true(on.iterations + on.factorisations < fresh.iterations + fresh.factorisations);
    solver_forget(t);
    equilibrium again = from_rest(t, next); /* nothing is left of the plans before */
    assert_memory_equal(again.xyz, fresh.xyz, 3 * (size_t)fresh.node_count * sizeof *fresh.xyz);
    equilibrium *all[] = {&a, &fresh, &on, &again};
    for (int i = 0; i < 4; i++) equilibrium_free(all[i]);
    solver_destroy(&t);
    solver_destroy(&other);
    touching_free(s);
}

static void the_next_plan_ends_where_one_from_rest_does(void **state)
{
    (void)state;
    touching s;
    block_on_plane(&s, 0.45);
    s.body.problem.contact = NULL;
    check_next_plan(&s, "sliding, without contact");
    block_over_plate(&s, 5);
    check_next_plan(&s, "over a plate, held");
    block_on_plane(&s, 0.45);
    s.setup.held = true;
    check_next_plan(&s, "on a plane, held");
    block_on_plane(&s, 0.45);
    check_next_plan(&s, "on a plane, not held");
}

/* A plate that rises through the lowest nodes of a block raises guards; a new solver of the same body takes them over.
 */
static void guards_are_handed_on(void **state)
{
    (void)state;
    touching s;
    rigid first[SEGMENT_COUNT], next[SEGMENT_COUNT];
    block_over_plate(&s, 0.8);
    rise(first, 3);
    rise(next, 3.5);
    solver *t = make(&s), *heir = make(&s);
    equilibrium a = from_rest(t, first);
    assert_true(a.contact.guards > 0);
    assert_int_equal(contact_measure(heir->touch).guards, 0);
    solver_inherit(heir, t);
    assert_int_equal(contact_measure(heir->touch).guards, a.contact.guards);
    equilibrium on = from_last(heir, first, next, a.xyz);
    assert_int_equal(on.contact.passed, 0);
    assert_int_equal(on.contact.guards, a.contact.guards);
    equilibrium fresh = from_rest(heir, next);
    assert_int_equal(fresh.contact.guards, a.contact.guards);
    equilibrium *all[] = {&a, &on, &fresh};
    for (int i = 0; i < 3; i++) equilibrium_free(all[i]);
    solver_destroy(&t);
    solver_destroy(&heir);
    touching_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_next_plan_ends_where_one_from_rest_does),
                                       cmocka_unit_test(guards_are_handed_on)};
    parallel_set_threads(1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
