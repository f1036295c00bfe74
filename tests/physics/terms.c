/* An energy of one's own on the solver's list of terms. */
#include "tests/check.h"
#include "sim/src/solve/solver_state.h"
#include "tests/physics/setting.h"

/* A pull and a spring to a place, the same at every node: sum of k/2 |x - p|^2 - f.x, where the spring has its
 * derivatives too. */
typedef struct tether {
    int32_t node_count;
    double k, place[3], pull[3];
} tether;

static double tether_energy(void *self, const double *x, double *force)
{
    const tether *t = self;
    double sum = 0;
    for (size_t i = 0; i < 3 * (size_t)t->node_count; i++) {
        double off = x[i] - t->place[i % 3];
        sum += t->k / 2 * off * off - t->pull[i % 3] * x[i];
        if (force) force[i] += t->k * off - t->pull[i % 3];
    }
    return sum;
}

static void tether_stiffness(void *self, const double *x, const double *force, projection how, assembly *a)
{
    (void)x, (void)force, (void)how;
    const tether *t = self;
    for (int32_t i = 0; i < a->edge_count; i++)
        for (int c = 0; a->edge_node[2 * i] == a->edge_node[2 * i + 1] && c < 9; c += 4)
            a->edge_block[9 * (size_t)i + (size_t)c] += t->k;
}

static void forces_of_a_term_are_carried_to_the_bones(void **state)
{
    (void)state;
    for (int way = LINEAR_FACTOR; way <= LINEAR_GRADIENTS; way++) {
        err e = {0};
        setting s;
        solver *t = NULL;
        equilibrium q, plain;
        block_setting(&s, 3, 0);
        solve_params params = solve_params_default();
        params.linear = (linear_kind)way;
        assert_ok(solver_create(&s.problem, 1, &t, &e));
        assert_ok(solver_solve(t, s.problem.motion, NULL, &params, &plain, &e));
        assert_int_equal(plain.iterations, 0);
        tether own = {t->b.node_count, 0.01, {20, 20, 10}, {5, -10, 20}};
        term_add(&t->terms, (term){.self = &own, .energy = tether_energy, .stiffness = tether_stiffness});
        assert_ok(solver_solve(t, s.problem.motion, NULL, &params, &q, &e));
        printf("%s: %d iterations, %d of conjugate gradients, moved %.2f mm\n",
               way == LINEAR_FACTOR ? "factors" : "gradients", q.iterations, q.cg_iterations, apart(&q, &plain));
        assert_int_equal(q.outcome, SOLVED);
        assert_true(q.residual_mn <= q.tolerance_mn && q.iterations > 0 && q.iterations < 12 &&
                    apart(&q, &plain) > 0.1);
        /* what the term pulls with is what the bones hold against: elastic forces sum to nothing */
        for (int c = 0; c < 3; c++) {
            double pulled = 0, held = 0;
            for (int32_t v = 0; v < q.node_count; v++)
                pulled += own.pull[c] - own.k * (q.xyz[3 * v + c] - own.place[c]);
            for (int b = 0; b < SEGMENT_COUNT; b++) held += q.segment_force_mn[b][c];
            assert_near(held, -pulled, 1e-6 * fabs(own.pull[c]) * q.node_count);
        }
        assert_near(q.energy_uj, assembly_energy(&t->a, q.xyz, NULL) + tether_energy(&own, q.xyz, NULL),
                    1e-12 * fabs(q.energy_uj));
        equilibrium_free(&q);
        equilibrium_free(&plain);
        solver_destroy(&t);
        tear_down(&s);
    }
}

static double no_energy(void *self, const double *x, double *force)
{
    (void)x, (void)force;
    ++*(int *)self;
    return HUGE_VAL;
}

static double counted(void *self, const double *x, double *force)
{
    (void)x;
    if (force) force[0] += 2;
    return ++*(int *)self;
}

static double first(void *self, const double *x, double *force)
{
    (void)x;
    if (force) force[0] = 1;
    return *(int *)self;
}

static void terms_are_summed_in_order_up_to_one_that_has_no_energy(void **state)
{
    (void)state;
    int value = 5, calls = 0, touching_calls = 0, none = 0, after = 0;
    double x[3] = {0}, force[3] = {7, 0, 0};
    term_list l = {0};
    term_add(&l, (term){.self = &value, .energy = first});
    term_add(&l, (term){.self = &calls, .energy = counted});
    term_add(&l, (term){.self = &touching_calls, .is_a_contact = true, .energy = counted});
    assert_true(term_energy(&l, false, x, force) == 6 && force[0] == 3);
    assert_true(term_energy(&l, true, x, force) == 8 && force[0] == 5);
    assert_true(term_energy(&l, true, x, NULL) == 10);
    term_add(&l, (term){.self = &none, .energy = no_energy});
    term_add(&l, (term){.self = &after, .energy = counted});
    assert_true(term_energy(&l, false, x, force) == HUGE_VAL);
    assert_int_equal(none, 1);
    assert_int_equal(after, 0);
    assert_int_equal(touching_calls, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_of_a_term_are_carried_to_the_bones),
        cmocka_unit_test(terms_are_summed_in_order_up_to_one_that_has_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
