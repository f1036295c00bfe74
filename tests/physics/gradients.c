/* Conjugate gradients and their multigrid preconditioner: what they are, what they cost, where they lead. */
#include "tests/check.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sim/src/linear/cg.h"
#include "sim/src/solve/descent.h"
#include "tests/physics/setting.h"
#include <string.h>

/* The matrix at rest, or with the bones moved and the tissue carried by nothing, as blocks. */
typedef struct equations {
    solver *t;
    node_blocks f;
    blocks k;
    multigrid *grid;
    double *b, *x;
} equations;

static void make_equations(const setting *s, double shake_mm, equations *out)
{
    err e = {0};
    bool definite = false;
    *out = (equations){0};
    assert_ok(solver_create(&s->problem, 1, &out->t, &e));
    solver *t = out->t;
    double *x = COPY_ARRAY(double, s->mesh.xyz, 3 * (size_t)s->mesh.vertex_count);
    uint64_t seed = 3;
    for (int32_t i = 0; i < 3 * s->mesh.vertex_count; i++) x[i] += shake_mm * block_random(&seed);
    assembly_stiffness(&t->a, x, PROJECTION_NONE);
    assembly_matrix(&t->a, &t->b);
    out->f = node_blocks_make(&t->b);
    out->k = node_blocks_matrix(&out->f, &t->a);
    node_blocks_fill(&out->f, &t->a, t->a.value, &out->k);
    double *modes = node_blocks_modes(&out->f, &t->b, s->mesh.xyz);
    assert_ok(multigrid_make(&out->k, modes, &out->grid, &definite, &e));
    if (shake_mm == 0) assert_true(definite);
    int32_t n = 3 * out->f.block_count;
    out->b = NEW_ARRAY(double, n);
    out->x = NEW_ARRAY(double, n);
    double *z = NEW_ARRAY(double, t->b.unknown_count);
    for (int32_t i = 0; i < t->b.unknown_count; i++) z[i] = block_random(&seed);
    node_blocks_scatter(&out->f, z, out->b);
    free(x);
    free(z);
    free(modes);
}

static void free_equations(equations *y)
{
    multigrid_destroy(&y->grid);
    blocks_free(&y->k);
    node_blocks_free(&y->f);
    free(y->b);
    free(y->x);
    solver_destroy(&y->t);
}

static void the_blocks_hold_the_matrix_of_the_unknowns(void **state)
{
    (void)state;
    setting s;
    equations y;
    lips_setting(&s);
    make_equations(&s, 0, &y);
    const assembly *a = &y.t->a;
    int32_t n = a->unknown_count, met = 0;
    double *z = NEW_ARRAY(double, n), *want = NEW_ARRAY(double, n), *got = NEW_ARRAY(double, n);
    node_blocks_gather(&y.f, y.b, z);
    for (int32_t j = 0; j < n; j++)
        for (int64_t k = a->column_start[j]; k < a->column_start[j + 1]; k++) {
            want[a->row[k]] += a->value[k] * z[j];
            if (a->row[k] != j) want[j] += a->value[k] * z[a->row[k]];
        }
    blocks_multiply(&y.k, y.b, y.x);
    node_blocks_gather(&y.f, y.x, got);
    for (int32_t i = 0; i < n; i++) assert_near(got[i], want[i], 1e-9);
    for (int32_t i = 0; i < y.k.rows; i++)
        for (int64_t k = y.k.start[i]; k < y.k.start[i + 1]; k++) {
            assert_true(k == y.k.start[i] || y.k.column[k] > y.k.column[k - 1]);
            met += y.k.column[k] == i;
        }
    assert_int_equal(met, y.k.rows);
    free(z);
    free(want);
    free(got);
    free_equations(&y);
    tear_down(&s);
}

static double dot(const double *a, const double *b, int32_t n)
{
    double sum = 0;
    for (int32_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void the_preconditioner_is_symmetric_and_positive_definite(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    equations y;
    slab_setting(&s, 3);
    make_equations(&s, 0, &y);
    int32_t n = 3 * y.k.rows;
    double *c = NEW_ARRAY(double, n), *Mc = NEW_ARRAY(double, n);
    uint64_t seed = 9;
    for (int k = 0; k < 5; k++) {
        for (int32_t i = 0; i < n; i++) c[i] = block_random(&seed);
        assert_ok(multigrid_apply(y.grid, y.b, y.x, &e));
        assert_ok(multigrid_apply(y.grid, c, Mc, &e));
        double scale = sqrt(dot(y.x, y.x, n) * dot(c, c, n));
        assert_near(dot(y.x, c, n), dot(Mc, y.b, n), 1e-5 * scale);
        assert_true(dot(c, Mc, n) > 0 && dot(y.b, y.x, n) > 0);
        memcpy(y.b, c, (size_t)n * sizeof *c);
    }
    free(c);
    free(Mc);
    free_equations(&y);
    tear_down(&s);
}

/* The point of it all: iterations that do not grow with the mesh, little with nu and stiffness contrasts. */
static void iterations_do_not_grow_with_the_mesh(void **state)
{
    (void)state;
    err e = {0};
    static const double poisson[] = {0.45, 0.49};
    for (int n = 0; n < 2; n++) {
        int most[3];
        for (int k = 0; k < 3; k++) {
            setting s;
            equations y;
            cg_result r;
            slab_setting(&s, 2 << k);
            s.table = tissue_material(MATERIAL_SNH_LOG, 15, poisson[n]);
            make_equations(&s, 0, &y);
            assert_ok(cg_solve(&y.k, y.grid, y.b, y.x, 1e-6, 200, &r, &e));
            assert_false(r.indefinite);
            assert_true(r.reduction <= 1e-6);
            double *rest = NEW_ARRAY(double, 3 * (size_t)y.k.rows), norm = 0, left = 0;
            blocks_multiply(&y.k, y.x, rest);
            for (int32_t i = 0; i < 3 * y.k.rows; i++) {
                norm += y.b[i] * y.b[i];
                left += (y.b[i] - rest[i]) * (y.b[i] - rest[i]);
            }
            assert_true(sqrt(left) < 1.01e-6 * sqrt(norm));
            free(rest);
            most[k] = r.iterations;
            print_message("nu %.2f, %d unknowns: %d iterations, %.1f MB\n", poisson[n], y.t->b.unknown_count,
                          r.iterations, multigrid_mb(y.grid));
            free_equations(&y);
            tear_down(&s);
        }
        assert_true(most[2] <= (n ? 45 : 25));
        assert_true(most[2] <= most[1] + 10); /* the first is all coarsest level */
    }
}

static void a_matrix_that_is_not_definite_is_found_out(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    equations y;
    cg_result r = {0};
    slab_setting(&s, 2);
    make_equations(&s, 0, &y);
    for (int64_t i = 0; i < y.k.rows; i++) /* far below the smallest eigenvalue */
        for (int64_t k = y.k.start[i]; k < y.k.start[i + 1]; k++)
            for (int c = 0; c < 3 && y.k.column[k] == i; c++) y.k.value[9 * k + 4 * c] *= 0.5;
    assert_ok(cg_solve(&y.k, y.grid, y.b, y.x, 1e-6, 200, &r, &e));
    assert_true(r.indefinite);
    assert_true(dot(y.x, y.b, 3 * y.k.rows) > 0);
    free_equations(&y);
    tear_down(&s);
}

static void gradients_and_factors_end_in_the_same_place(void **state)
{
    (void)state;
    setting s[2];
    lips_setting(&s[0]);
    slab_setting(&s[1], 3);
    for (int n = 0; n < 2; n++) {
        solve_params params = solve_params_default();
        params.rel_tol = 1e-11;
        params.linear = LINEAR_FACTOR;
        equilibrium want = solve(&s[n], &params);
        params.linear = LINEAR_GRADIENTS;
        equilibrium got = solve(&s[n], &params);
        assert_int_equal(want.outcome, SOLVED);
        assert_int_equal(got.outcome, SOLVED);
        assert_true(want.cg_iterations == 0 && want.factorisations > 0);
        assert_true(got.cg_iterations > 0 && got.factorisations == 0);
        assert_true(apart(&want, &got) < 1e-8);
        equilibrium_free(&want);
        equilibrium_free(&got);
        tear_down(&s[n]);
    }
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    setting s;
    slab_setting(&s, 5);
    solve_params params = solve_params_default();
    params.linear = LINEAR_GRADIENTS;
    equilibrium first = {0};
    const int threads[] = {1, 2, 3, 8};
    for (int k = 0; k < 4; k++) {
        parallel_set_threads(threads[k]);
        equilibrium q = solve(&s, &params);
        assert_int_equal(q.outcome, SOLVED);
        if (k == 0) {
            first = q;
            continue;
        }
        assert_memory_equal(q.xyz, first.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
        assert_true(q.energy_uj == first.energy_uj && q.residual_mn == first.residual_mn);
        assert_int_equal(q.cg_iterations, first.cg_iterations);
        equilibrium_free(&q);
    }
    parallel_set_threads(0);
    equilibrium_free(&first);
    tear_down(&s);
}

/* The next plan from the last solution takes less, and ends where it would from rest. */
static void the_next_plan_starts_from_the_last(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    slab_setting(&s, 4);
    solve_params params = solve_params_default();
    params.linear = LINEAR_GRADIENTS;
    params.rel_tol = 1e-10;
    solver *t = NULL;
    equilibrium q, next;
    assert_ok(solver_create(&s.problem, 1, &t, &e));
    assert_ok(solver_solve(t, s.problem.motion, NULL, &params, &q, &e));
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 7});
    assert_ok(solver_solve(t, s.problem.motion, q.xyz, &params, &next, &e));
    equilibrium fresh = solve(&s, &params);
    assert_int_equal(next.outcome, SOLVED);
    assert_true(apart(&next, &fresh) < 1e-7);
    assert_true(next.cg_iterations < fresh.cg_iterations);
    equilibrium_free(&q);
    equilibrium_free(&next);
    equilibrium_free(&fresh);
    solver_destroy(&t);
    tear_down(&s);
}

static void what_buckles_or_is_stiff_in_places_is_solved(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    block_setting(&s, 6, 0.8);
    solve_params params = solve_params_default();
    params.linear = LINEAR_GRADIENTS;
    equilibrium q = solve(&s, &params);
    print_message("compressed to 20 %%: %s, %d iterations, %d of gradients, %d factorisations, min J %.4f\n",
                  solve_outcome_text(q.outcome), q.iterations, q.cg_iterations, q.factorisations, q.extremes.min_j);
    assert_int_equal(q.outcome, SOLVED);
    assert_true(q.residual_mn <= q.tolerance_mn);
    equilibrium_free(&q);
    block_setting(&s, 5, 0.1);
    region_material table[2] = {s.table, {1, {0}}};
    for (int32_t t = s.mesh.tet_count / 5; t < 2 * s.mesh.tet_count / 5; t++) s.mesh.region[t] = 1;
    assert_ok(material_make(MATERIAL_SNH_LOG, 15e6, 0.45, &table[1].material, &e));
    s.problem.materials = table;
    s.problem.material_count = 2;
    q = solve(&s, &params);
    params.linear = LINEAR_FACTOR;
    equilibrium want = solve(&s, &params);
    assert_int_equal(q.outcome, SOLVED);
    assert_int_equal(want.outcome, SOLVED);
    print_message("a layer 1e6 times stiffer: %d iterations, %d of gradients, %d factorisations (factors: %d, "
                  "%d), %.2g mm apart\n",
                  q.iterations, q.cg_iterations, q.factorisations, want.iterations, want.factorisations,
                  apart(&q, &want));
    assert_true(apart(&q, &want) < 1e-3); /* 1e-8 of a residual that holds the stiff layer's forces */
    equilibrium_free(&q);
    equilibrium_free(&want);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_blocks_hold_the_matrix_of_the_unknowns),
        cmocka_unit_test(the_preconditioner_is_symmetric_and_positive_definite),
        cmocka_unit_test(iterations_do_not_grow_with_the_mesh),
        cmocka_unit_test(a_matrix_that_is_not_definite_is_found_out),
        cmocka_unit_test(gradients_and_factors_end_in_the_same_place),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
        cmocka_unit_test(the_next_plan_starts_from_the_last),
        cmocka_unit_test(what_buckles_or_is_stiff_in_places_is_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
