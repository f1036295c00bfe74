/* Points drawn to places: derivatives, closed forms, what holds a body, one solver for many places. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "sim/solver.h"
#include "sim/src/solve/solver_state.h"
#include "tests/physics/setting.h"
#include <string.h>

/* A block that hangs on no bone, with points in its tets drawn to where they are. */
typedef struct drawn {
    setting s;
    targets t;
} drawn;

static void random_unit(uint64_t *seed, double n[3])
{
    for (int c = 0; c < 3; c++) n[c] = block_random(seed);
    vec_normalize(n);
}

static void drawn_block(drawn *d, int32_t points, double across)
{
    block b = {5, 4, 6, {20, 16, 24}, 5, 0.2};
    uint64_t seed = 7;
    *d = (drawn){.s = {.mesh = block_mesh(&b), .table = tissue_material(MATERIAL_SNH_LOG, 15, 0.3)},
                 .t = targets_new(points)};
    d->s.attach = attach_map_new(d->s.mesh.vertex_count, 0);
    wire(&d->s);
    for (int32_t k = 0; k < points; k++) {
        double *w = d->t.weight + 4 * (size_t)k;
        d->t.tet[k] = (int32_t)(((int64_t)k * 7919) % d->s.mesh.tet_count);
        for (int a = 0; a < 3; a++) w[a] = 0.25 + 0.3 * block_random(&seed); /* some outside their tet */
        w[3] = 1 - w[0] - w[1] - w[2];
        random_unit(&seed, d->t.normal + 3 * (size_t)k);
        d->t.stiffness[k] = 20 + 10 * block_random(&seed);
        d->t.across[k] = across;
        targets_point(&d->t, &d->s.mesh, d->s.mesh.xyz, k, d->t.place + 3 * (size_t)k);
    }
    d->s.problem.targets = &d->t;
}

static void free_drawn(drawn *d)
{
    tear_down(&d->s);
    targets_free(&d->t);
}

static void move_places(drawn *d, const rigid *motion)
{
    for (size_t k = 0; k < (size_t)d->t.count; k++) {
        rigid_apply(motion, d->t.place + 3 * k, d->t.place + 3 * k);
        rigid_rotate(motion, d->t.normal + 3 * k, d->t.normal + 3 * k);
    }
}

static void force_and_stiffness_are_the_derivatives_of_the_energy(void **state)
{
    (void)state;
    err e = {0};
    drawn d;
    solver *t = NULL;
    drawn_block(&d, 40, 0.3);
    assert_ok(solver_create(&d.s.problem, 1, &t, &e));
    size_t n = 3 * (size_t)t->b.node_count;
    term pull = target_term(t->pull);
    double *x = COPY_ARRAY(double, d.s.mesh.xyz, n), *force = NEW_ARRAY(double, n), *dir = NEW_ARRAY(double, n),
           *product = NEW_ARRAY(double, n), *other = NEW_ARRAY(double, n);
    uint64_t seed = 5;
    for (size_t i = 0; i < n; i++) x[i] += 2 * block_random(&seed);
    pull.energy(pull.self, x, force);
    memset(t->a.edge_block, 0, 9 * (size_t)t->a.edge_count * sizeof(double));
    pull.stiffness(pull.self, x, NULL, PROJECTION_NONE, &t->a);
    for (int trial = 0; trial < 4; trial++) {
        const double h = 1e-3; /* of a quadratic energy differences are exact but for rounding */
        double slope = 0, up, down;
        memset(other, 0, n * sizeof *other);
        for (size_t i = 0; i < n; i++) dir[i] = block_random(&seed);
        for (size_t i = 0; i < n; i++) slope += force[i] * dir[i];
        for (size_t i = 0; i < n; i++) x[i] += h * dir[i];
        up = pull.energy(pull.self, x, other);
        for (size_t i = 0; i < n; i++) x[i] -= 2 * h * dir[i];
        down = pull.energy(pull.self, x, NULL);
        for (size_t i = 0; i < n; i++) x[i] += h * dir[i];
        assert_near((up - down) / (2 * h), slope, 1e-8 * fabs(slope));
        assembly_multiply(&t->a, dir, product);
        for (size_t i = 0; i < n; i++) assert_near((other[i] - force[i]) / h, product[i], 1e-6);
    }
    free(x), free(force), free(dir), free(product), free(other);
    solver_destroy(&t);
    free_drawn(&d);
}

static void what_is_drawn_to_where_it_is_stays(void **state)
{
    (void)state;
    drawn d;
    drawn_block(&d, 40, 0.2);
    solve_params params = solve_params_default();
    equilibrium q = solve(&d.s, &params);
    assert_int_equal(q.outcome, SOLVED);
    assert_int_equal(q.iterations, 0);
    for (int32_t i = 0; i < 3 * q.node_count; i++) assert_near(q.xyz[i], d.s.mesh.xyz[i], 1e-12);
    equilibrium_free(&q);
    free_drawn(&d);
}

static void a_rigid_motion_of_all_places_carries_the_body(void **state)
{
    (void)state;
    static const double across[] = {1, 0.1, 0};
    for (int k = 0; k < 3; k++) {
        drawn d;
        drawn_block(&d, 60, across[k]);
        rigid motion = rigid_rotation((double[]){3, 1, 4}, (double[]){0.6, 0, 0.8}, k == 2 ? 0.3 : 1.5);
        motion.t[1] += 12;
        move_places(&d, &motion);
        solve_params params = solve_params_default();
        params.rel_tol = 1e-10;
        equilibrium q = solve(&d.s, &params);
        print_message("across %.1f: %s, %d iterations\n", across[k], solve_outcome_text(q.outcome), q.iterations);
        assert_int_equal(q.outcome, SOLVED);
        for (int32_t v = 0; v < q.node_count; v++) {
            double want[3];
            rigid_apply(&motion, d.s.mesh.xyz + 3 * (size_t)v, want);
            assert_true(vec_distance(q.xyz + 3 * (size_t)v, want) < 1e-6);
        }
        equilibrium_free(&q);
        free_drawn(&d);
    }
}

/* Springs of stiffness k in all at each end of a bar, drawn h beyond it: of 2 h the bar, of stiffness E A / L, takes
 * its share in a row with them. nu = 0 and a little h. */
static void a_bar_stretches_as_its_springs_and_it_in_series(void **state)
{
    (void)state;
    const double young = 15, k = 5, h = 0.01, length = 24, area = 20 * 16;
    block b = {5, 4, 6, {20, 16, 24}, 6, 0};
    setting s = {.mesh = block_mesh(&b), .table = tissue_material(MATERIAL_SNH_LOG, young, 0)};
    s.attach = attach_map_new(s.mesh.vertex_count, 0);
    wire(&s);
    int32_t *face, *of, count = tetmesh_boundary(&s.mesh, &face, &of);
    targets t = targets_new(3 * count); /* the ends by the middles of their triangles: uniform pressure */
    t.count = 0;
    for (int32_t f = 0; f < count; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        double z[3], *const x = s.mesh.xyz;
        for (int c = 0; c < 3; c++) z[c] = x[3 * (size_t)v[c] + 2];
        bool top = fmin(z[0], fmin(z[1], z[2])) > 24 - 1e-9, bottom = fmax(z[0], fmax(z[1], z[2])) < 1e-9;
        if (!top && !bottom) continue;
        for (int c = 0; c < 4; c++)
            for (int i = 0; i < 3; i++)
                if (s.mesh.tet[4 * (size_t)of[f] + (size_t)c] == v[i]) t.weight[4 * t.count + c] = 1.0 / 3;
        t.tet[t.count] = of[f];
        targets_point(&t, &s.mesh, x, t.count, t.place + 3 * (size_t)t.count);
        t.place[3 * t.count + 2] += top ? h : -h;
        t.normal[3 * t.count + 2] = 1;
        t.stiffness[t.count] = k / (2 * 5 * 4);
        t.across[t.count++] = 1e-6; /* against sideways motion */
    }
    free(face), free(of);
    s.problem.targets = &t;
    solve_params params = solve_params_default();
    params.rel_tol = 1e-11;
    equilibrium q = solve(&s, &params);
    assert_int_equal(q.outcome, SOLVED);
    double low = 0, high = 0, want = 2 * h / (1 + 2 * young * area / (k * length)); /* of the bar's stretch, mm */
    for (int32_t v = 0; v < q.node_count; v++) {
        low = fmin(low, q.xyz[3 * (size_t)v + 2]);
        high = fmax(high, q.xyz[3 * (size_t)v + 2]);
    }
    assert_near(high - low - length, want, 2e-3 * want);
    equilibrium_free(&q);
    targets_free(&t);
    tear_down(&s);
}

static void too_few_targets_do_not_hold_a_body(void **state)
{
    (void)state;
    err e = {0};
    solver *t = NULL;
    drawn d;
    drawn_block(&d, 5, 0); /* five planes leave a motion */
    assert_refused(solver_create(&d.s.problem, 1, &t, &e), ERR_GEOMETRY);
    d.t.across[0] = 1;
    d.t.across[1] = 1;
    assert_ok(solver_create(&d.s.problem, 1, &t, &e));
    solver_destroy(&t);
    for (int32_t k = 0; k < 5; k++) d.t.stiffness[k] = 0;
    assert_refused(solver_create(&d.s.problem, 1, &t, &e), ERR_GEOMETRY);
    d.t.stiffness[3] = -1;
    assert_refused(solver_create(&d.s.problem, 1, &t, &e), ERR_INPUT);
    assert_null(t);
    free_drawn(&d);
}

static void one_solver_follows_places_that_change(void **state)
{
    (void)state;
    for (int way = LINEAR_FACTOR; way <= LINEAR_GRADIENTS; way++) {
        err e = {0};
        drawn d;
        drawn_block(&d, 80, 0.5);
        solve_params params = solve_params_default();
        params.linear = (linear_kind)way;
        params.rel_tol = 1e-10;
        solver *t = NULL;
        equilibrium q = {0}, fresh;
        assert_ok(solver_create(&d.s.problem, 1, &t, &e));
        double *start = COPY_ARRAY(double, d.s.mesh.xyz, 3 * (size_t)d.s.mesh.vertex_count);
        for (int k = 0; k < 3; k++) {
            rigid on = rigid_rotation((double[]){0, 0, 9}, (double[]){0, 1, 0}, 0.1 * (k + 1));
            move_places(&d, &on);
            for (int32_t i = 0; i < d.t.count; i++) d.t.stiffness[i] *= 3;
            d.t.place[3 * k] += 2;
            assert_ok(solver_solve(t, d.s.problem.motion, start, &params, &q, &e));
            assert_int_equal(q.outcome, SOLVED);
            memcpy(start, q.xyz, 3 * (size_t)q.node_count * sizeof *start);
            if (k < 2) equilibrium_free(&q);
        }
        fresh = solve(&d.s, &params);
        assert_int_equal(fresh.outcome, SOLVED);
        assert_true(apart(&q, &fresh) < 1e-5);
        equilibrium_free(&q);
        equilibrium_free(&fresh);
        free(start);
        solver_destroy(&t);
        free_drawn(&d);
    }
}

static void every_thread_count_gives_the_same_bits(void **state)
{
    (void)state;
    const int threads[] = {1, 2, 3, 8};
    equilibrium first = {0};
    drawn d;
    drawn_block(&d, 2000, 0.4);
    uint64_t seed = 11;
    for (size_t i = 0; i < 3 * (size_t)d.t.count; i++) d.t.place[i] += block_random(&seed);
    solve_params params = solve_params_default();
    for (int k = 0; k < 4; k++) {
        parallel_set_threads(threads[k]);
        equilibrium q = solve(&d.s, &params);
        assert_int_equal(q.outcome, SOLVED);
        if (k == 0) {
            first = q;
            continue;
        }
        assert_memory_equal(q.xyz, first.xyz, 3 * (size_t)q.node_count * sizeof *q.xyz);
        assert_true(q.energy_uj == first.energy_uj);
        equilibrium_free(&q);
    }
    parallel_set_threads(0);
    equilibrium_free(&first);
    free_drawn(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_and_stiffness_are_the_derivatives_of_the_energy),
        cmocka_unit_test(what_is_drawn_to_where_it_is_stays),
        cmocka_unit_test(a_rigid_motion_of_all_places_carries_the_body),
        cmocka_unit_test(a_bar_stretches_as_its_springs_and_it_in_series),
        cmocka_unit_test(too_few_targets_do_not_hold_a_body),
        cmocka_unit_test(one_solver_follows_places_that_change),
        cmocka_unit_test(every_thread_count_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
