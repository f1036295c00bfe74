/* The whole solve: against theory and against itself. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "sim/src/solve/descent.h"
#include "tests/physics/evidence.h"
#include "tests/physics/setting.h"
#include <string.h>

static void an_affine_boundary_gives_an_affine_inside(void **state)
{
    (void)state;
    static const double A[9] = {1.2, 0.1, -0.05, 0.15, 0.9, 0.2, -0.1, 0.05, 1.1};
    double worst = 0;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++) {
        err e = {0};
        block b = {4, 5, 3, {4, 5, 3}, model % 2 ? 5 : 6, 0.25};
        setting s = {.mesh = block_mesh(&b),
                     .table = tissue_material((material_model)model, 15, model == MATERIAL_ARAP ? 0 : 0.45)};
        s.attach = attach_map_new(s.mesh.vertex_count, 0);
        for (int32_t v = 0; v < s.mesh.vertex_count; v++)
            for (int c = 0; c < 3; c++) {
                double x = s.mesh.xyz[3 * (size_t)v + c];
                if (x == 0 || x == b.size[c]) tie(&s.attach, v, SEGMENT_MAXILLA);
            }
        wire(&s);
        solver *t = NULL;
        assert_ok(solver_create(&s.problem, 1, &t, &e));
        for (int32_t v = 0; v < s.mesh.vertex_count; v++)
            if (s.attach.kind[v] == NODE_TIED) mat_apply(A, s.mesh.xyz + 3 * (size_t)v, t->b.origin + 3 * (size_t)v);
        solve_params params = solve_params_default();
        equilibrium q = {0};
        descent d;
        solve_outcome outcome;
        descent_make(&d, t, &params, &q);
        assert_ok(load_run(&d, &(load_task){.load = 1, .rel_tol = 1e-15}, s.mesh.xyz, &outcome, &e));
        assert_int_equal(outcome, SOLVED);
        assert_true(d.t->b.unknown_count > 30);
        for (int32_t v = 0; v < s.mesh.vertex_count; v++) {
            double want[3];
            mat_apply(A, s.mesh.xyz + 3 * (size_t)v, want);
            assert_near(keep_worst(&worst, vec_distance(want, d.here.x + 3 * (size_t)v)), 0, 1e-12);
        }
        descent_free(&d);
        equilibrium_free(&q);
        solver_destroy(&t);
        tear_down(&s);
    }
    evidence("patch test: affine boundary, every material: worst node", worst, "mm");
}

static void the_matrix_is_the_derivative_of_the_forces_on_the_unknowns(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    lips_setting(&s);
    solver *t = NULL;
    assert_ok(solver_create(&s.problem, 1, &t, &e));
    boundary_move(&t->b, &s.mesh, &s.attach, s.problem.motion);
    int32_t n = t->b.unknown_count;
    size_t nodes = (size_t)s.mesh.vertex_count;
    uint64_t seed = 2;
    double *z = NEW_ARRAY(double, n), *w = NEW_ARRAY(double, n), *x = NEW_ARRAY(double, 3 * nodes);
    double *f = NEW_ARRAY(double, 3 * nodes), *up = NEW_ARRAY(double, n), *down = NEW_ARRAY(double, n);
    double *Kw = NEW_ARRAY(double, n), h = 1e-5;
    for (int32_t i = 0; i < n; i++) {
        z[i] = 0.3 * block_random(&seed);
        w[i] = block_random(&seed);
    }
    boundary_place(&t->b, z, x);
    boundary_project(&t->b, x, up);
    for (int32_t i = 0; i < n; i++) assert_near(up[i], z[i], 1e-13);
    assembly_stiffness(&t->a, x, PROJECTION_NONE);
    assembly_matrix(&t->a, &t->b);
    for (int32_t j = 0; j < n; j++)
        for (int64_t k = t->a.column_start[j]; k < t->a.column_start[j + 1]; k++) {
            int64_t i = t->a.row[k];
            assert_true(i >= j);
            assert_true(k > t->a.column_start[j] ? i > t->a.row[k - 1] : i == j);
            Kw[i] += t->a.value[k] * w[j];
            if (i != j) Kw[j] += t->a.value[k] * w[i];
        }
    double energy[2];
    for (int side = 0; side < 2; side++) {
        for (int32_t i = 0; i < n; i++) z[i] += (side ? -2 * h : h) * w[i];
        boundary_place(&t->b, z, x);
        energy[side] = assembly_energy(&t->a, x, f);
        boundary_reduce(&t->b, f, side ? down : up);
    }
    double slope = 0, scale = 0;
    for (int32_t i = 0; i < n; i++) scale = fmax(scale, fabs(Kw[i]));
    for (int32_t i = 0; i < n; i++) {
        assert_near((up[i] - down[i]) / (2 * h), Kw[i], 1e-7 * scale);
        slope += (up[i] + down[i]) / 2 * w[i];
    }
    assert_near((energy[0] - energy[1]) / (2 * h), slope, 1e-7 * fabs(slope));
    free(z);
    free(w);
    free(x);
    free(f);
    free(up);
    free(down);
    free(Kw);
    solver_destroy(&t);
    tear_down(&s);
}

static void displacements_do_not_depend_on_young(void **state)
{
    (void)state;
    setting s;
    lips_setting(&s);
    solve_params params = solve_params_default();
    params.rel_tol = 1e-11;
    equilibrium soft = solve(&s, &params);
    s.table = tissue_material(MATERIAL_SNH_LOG, 15e3, 0.47);
    equilibrium stiff = solve(&s, &params);
    assert_int_equal(soft.outcome, SOLVED);
    assert_int_equal(stiff.outcome, SOLVED);
    assert_true(apart(&soft, &stiff) < 1e-9);
    evidence("Young's modulus times 1000: displacements differ by", apart(&soft, &stiff), "mm");
    assert_near(stiff.energy_uj / soft.energy_uj, 1000, 1e-6);
    equilibrium_free(&soft);
    equilibrium_free(&stiff);
    tear_down(&s);
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    setting s[2];
    lips_setting(&s[0]);
    slab_setting(&s[1], 3);
    solve_params params = solve_params_default();
    for (int n = 0; n < 2; n++) {
        equilibrium first = {0};
        const int threads[] = {1, 2, 3, 8};
        for (int k = 0; k < 4; k++) {
            parallel_set_threads(threads[k]);
            equilibrium q = solve(&s[n], &params);
            assert_int_equal(q.outcome, SOLVED);
            if (k == 0) {
                first = q;
                continue;
            }
            assert_memory_equal(q.xyz, first.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
            assert_true(q.energy_uj == first.energy_uj && q.residual_mn == first.residual_mn);
            equilibrium_free(&q);
        }
        equilibrium_free(&first);
        tear_down(&s[n]);
    }
    parallel_set_threads(0);
}

static void every_way_to_the_equilibrium_ends_in_the_same_place(void **state)
{
    (void)state;
    setting s;
    lips_setting(&s);
    solve_params params = solve_params_default();
    params.rel_tol = 1e-11;
    equilibrium q = solve(&s, &params), other;
    assert_int_equal(q.outcome, SOLVED);
    params.reuse_factor = false;
    other = solve(&s, &params);
    assert_int_equal(other.outcome, SOLVED);
    assert_true(apart(&q, &other) < 1e-8);
    equilibrium_free(&other);
    params.load_steps = 4;
    other = solve(&s, &params);
    assert_int_equal(other.outcome, SOLVED);
    assert_int_equal(other.loads, 4);
    assert_true(apart(&q, &other) < 1e-8);
    equilibrium_free(&other);
    params = solve_params_default();
    params.rel_tol = 1e-11;
    params.predictor = PREDICT_RIGID;
    params.projection = PROJECTION_ABS;
    other = solve(&s, &params);
    assert_int_equal(other.outcome, SOLVED);
    assert_true(apart(&q, &other) < 1e-8);
    equilibrium_free(&other);
    /* a good guess is taken as it is */
    params.predictor = PREDICT_ELASTIC;
    params.rel_tol = 1e-8;
    s.problem.start_xyz = q.xyz;
    other = solve(&s, &params);
    assert_int_equal(other.outcome, SOLVED);
    assert_int_equal(other.iterations, 0);
    assert_int_equal(other.factorisations, 0);
    assert_true(apart(&q, &other) < 1e-9);
    equilibrium_free(&other);
    equilibrium_free(&q);
    tear_down(&s);
}

static void newton_converges_quadratically(void **state)
{
    (void)state;
    setting s;
    slab_setting(&s, 2);
    solve_params params = solve_params_default();
    params.reuse_factor = false;
    params.rel_tol = 1e-12;
    equilibrium q = solve(&s, &params);
    assert_int_equal(q.outcome, SOLVED);
    assert_true(q.iterations <= 6);
    const solve_record *last = &q.record[q.record_count - 1];
    double r0 = last[-2].residual_mn / q.reference_mn, r1 = last[-1].residual_mn / q.reference_mn;
    assert_true(r1 < 10 * pow(r0, 1.6));
    equilibrium_free(&q);
    tear_down(&s);
}

static void a_prepared_tissue_solves_plan_after_plan(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    slab_setting(&s, 2);
    solve_params params = solve_params_default();
    solver *t = NULL;
    assert_ok(solver_create(&s.problem, 1, &t, &e));
    for (int n = 0; n < 3; n++) {
        equilibrium kept;
        s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){n, 2, 6 - n});
        assert_ok(solver_solve(t, s.problem.motion, NULL, &params, &kept, &e));
        equilibrium fresh = solve(&s, &params);
        assert_memory_equal(kept.xyz, fresh.xyz, 3 * (size_t)kept.node_count * sizeof *kept.xyz);
        assert_int_equal(kept.factorisations, fresh.factorisations);
        equilibrium_free(&kept);
        equilibrium_free(&fresh);
    }
    solver_destroy(&t);
    tear_down(&s);
}

static void parameters_out_of_range_are_refused(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    lips_setting(&s);
    equilibrium q;
    solve_params params = solve_params_default();
    params.load_steps = 0;
    assert_refused(equilibrium_solve(&s.problem, &params, &q, &e), ERR_INPUT);
    params = solve_params_default();
    params.rel_tol = nan("");
    assert_refused(equilibrium_solve(&s.problem, &params, &q, &e), ERR_INPUT);
    params = solve_params_default();
    s.problem.motion[SEGMENT_CHIN].r[0] = 2;
    assert_refused(equilibrium_solve(&s.problem, &params, &q, &e), ERR_INPUT);
    tear_down(&s);
}

static void tissue_tied_throughout_needs_no_solve(void **state)
{
    (void)state;
    setting s;
    lips_setting(&s);
    for (int32_t v = 0; v < s.mesh.vertex_count; v++) tie(&s.attach, v, SEGMENT_MAXILLA);
    s.attach.pair_count = 0;
    solve_params params = solve_params_default();
    equilibrium q = solve(&s, &params);
    assert_int_equal(q.outcome, SOLVED);
    assert_int_equal(q.unknown_count, 0);
    equilibrium_free(&q);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_affine_boundary_gives_an_affine_inside),
        cmocka_unit_test(the_matrix_is_the_derivative_of_the_forces_on_the_unknowns),
        cmocka_unit_test(displacements_do_not_depend_on_young),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
        cmocka_unit_test(every_way_to_the_equilibrium_ends_in_the_same_place),
        cmocka_unit_test(newton_converges_quadratically),
        cmocka_unit_test(a_prepared_tissue_solves_plan_after_plan),
        cmocka_unit_test(parameters_out_of_range_are_refused),
        cmocka_unit_test(tissue_tied_throughout_needs_no_solve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
