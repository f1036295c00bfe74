/* Tets that are guarded against being turned inside out. */
#include "tests/check.h"
#include "geometry/mem.h"
#include "sim/src/elastic/crush.h"
#include "tests/physics/setting.h"
#include <string.h>

static const double least_j = 0.05;

/* A block whose nodes are shaken so much that tets have little volume or less than none; x[3*nodes], the caller frees.
 */
static double *shaken(setting *s, assembly *a, boundary *b)
{
    err e = {0};
    elements el = {0};
    block_setting(s, 1, 0);
    assert_ok(elements_make(&s->mesh, &s->table, 1, &el, &e));
    assert_ok(boundary_make(&s->mesh, &s->attach, b, &e));
    assert_ok(assembly_make(&s->mesh, &el, b, NULL, 0, a, &e));
    double *x = COPY_ARRAY(double, s->mesh.xyz, 3 * (size_t)s->mesh.vertex_count);
    uint64_t seed = 5;
    for (int32_t i = 0; i < 3 * s->mesh.vertex_count; i++) x[i] += 22 * block_random(&seed);
    return x;
}

static void its_forces_and_stiffness_are_derivatives(void **state)
{
    (void)state;
    setting s;
    assembly a;
    boundary b;
    double *x = shaken(&s, &a, &b);
    int32_t n = 3 * s.mesh.vertex_count;
    uint8_t *fixed = NEW_ARRAY(uint8_t, s.mesh.vertex_count);
    crush c = {.a = &a};
    crush_begin(&c, 0.3);
    assert_true(crush_stiffen(&c, fixed, false, x));
    deformation_extremes ex = assembly_extremes(&a, x, false);
    assert_true(ex.inverted_count > 0 && ex.inverted_count < c.count); /* both branches of the pressure */
    term t = crush_term(&c);
    double *d = NEW_ARRAY(double, n), *force = NEW_ARRAY(double, n), *y = NEW_ARRAY(double, n), step = 1e-5;
    double *ahead = NEW_ARRAY(double, n), *behind = NEW_ARRAY(double, n), *got = NEW_ARRAY(double, n), slope = 0;
    uint64_t seed = 8;
    for (int32_t i = 0; i < n; i++) d[i] = block_random(&seed);
    double energy = t.energy(t.self, x, force);
    assert_true(energy > 0);
    for (int32_t i = 0; i < n; i++) slope += force[i] * d[i];
    for (int32_t i = 0; i < n; i++) y[i] = x[i] + step * d[i];
    double more = t.energy(t.self, y, ahead);
    for (int32_t i = 0; i < n; i++) y[i] = x[i] - step * d[i];
    double less = t.energy(t.self, y, behind);
    assert_near((more - less) / (2 * step), slope, 1e-6 * fabs(slope));
    memset(a.edge_block, 0, 9 * (size_t)a.edge_count * sizeof *a.edge_block);
    t.stiffness(t.self, x, NULL, PROJECTION_NONE, &a);
    assembly_multiply(&a, d, got);
    double size = 0;
    for (int32_t i = 0; i < n; i++) size = fmax(size, fabs(got[i]));
    for (int32_t i = 0; i < n; i++) assert_near((ahead[i] - behind[i]) / (2 * step), got[i], 1e-6 * size);
    /* clamped: no direction goes down */
    memset(a.edge_block, 0, 9 * (size_t)a.edge_count * sizeof *a.edge_block);
    t.stiffness(t.self, x, NULL, PROJECTION_CLAMP, &a);
    for (int k = 0; k < 20; k++) {
        double along = 0;
        for (int32_t i = 0; i < n; i++) d[i] = block_random(&seed);
        assembly_multiply(&a, d, got);
        for (int32_t i = 0; i < n; i++) along += d[i] * got[i];
        assert_true(along >= -1e-9 * size);
    }
    double *const all[] = {x, d, force, y, ahead, behind, got};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) free(all[k]);
    free(fixed);
    crush_free(&c);
    assembly_free(&a);
    boundary_free(&b);
    tear_down(&s);
}

static void what_is_fixed_has_no_guard(void **state)
{
    (void)state;
    setting s;
    assembly a;
    boundary b;
    double *x = shaken(&s, &a, &b);
    uint8_t *fixed = NEW_ARRAY(uint8_t, s.mesh.vertex_count);
    memset(fixed, 1, (size_t)s.mesh.vertex_count);
    crush c = {.a = &a};
    crush_begin(&c, least_j);
    assert_false(crush_stiffen(&c, fixed, false, x));
    memset(fixed, 0, (size_t)s.mesh.vertex_count);
    assert_true(crush_stiffen(&c, fixed, false, x));
    int32_t count = c.count;
    double first = c.tet[0].pressure_kpa;
    assert_false(crush_stiffen(&c, fixed, false, x)); /* all are guarded */
    assert_true(crush_stiffen(&c, fixed, true, x));
    assert_int_equal(c.count, count);
    assert_true(c.tet[0].pressure_kpa == 4 * first);
    free(x);
    free(fixed);
    crush_free(&c);
    assembly_free(&a);
    boundary_free(&b);
    tear_down(&s);
}

/* A block pressed and dragged so far that tets at its rim turn inside out. */
static void a_result_has_no_tet_inside_out(void **state)
{
    (void)state;
    for (double drag = 6; drag <= 14; drag += 4) {
        setting s;
        solve_params params = solve_params_default();
        block_setting(&s, 3, 0.6);
        s.problem.motion[SEGMENT_MAXILLA].t[1] = drag;
        equilibrium without = solve(&s, &params);
        params.least_j = least_j;
        equilibrium with = solve(&s, &params);
        print_message("dragged %.0f mm: %d tets inside out, least J %.3f, %d iterations; guarded %d: %.3f, %d\n", drag,
                      without.extremes.inverted_count, without.extremes.min_j, without.iterations, with.crushed_tets,
                      with.extremes.min_j, with.iterations);
        assert_true(without.outcome == SOLVED && with.outcome == SOLVED);
        assert_true(without.extremes.inverted_count > 0 && without.crushed_tets == 0);
        assert_true(with.extremes.min_j >= least_j && with.crushed_tets > 0);
        assert_true(with.iterations > without.iterations);
        equilibrium_free(&without);
        equilibrium_free(&with);
        tear_down(&s);
    }
}

static void a_result_that_needs_no_guard_does_not_pay(void **state)
{
    (void)state;
    setting s;
    solve_params params = solve_params_default();
    block_setting(&s, 3, 0.2);
    equilibrium without = solve(&s, &params);
    params.least_j = least_j;
    equilibrium with = solve(&s, &params);
    assert_int_equal(with.crushed_tets, 0);
    assert_int_equal(with.iterations, without.iterations);
    assert_memory_equal(with.xyz, without.xyz, 3 * (size_t)with.node_count * sizeof *with.xyz);
    equilibrium_free(&without);
    equilibrium_free(&with);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_forces_and_stiffness_are_derivatives), cmocka_unit_test(what_is_fixed_has_no_guard),
        cmocka_unit_test(a_result_has_no_tet_inside_out), cmocka_unit_test(a_result_that_needs_no_guard_does_not_pay)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
