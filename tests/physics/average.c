/* Averaged volume changes: derivatives, patch, rigid motion, several materials, threads, ways to solve, locking. */
#include "tests/check.h"
#include "geometry/parallel.h"
#include "sim/src/solve/descent.h"
#include "tests/physics/block.h"
#include <string.h>

enum { LAYERS = 3 };

typedef struct setting {
    tetmesh mesh;
    attach_map attach;
    region_material table[LAYERS];
    equilibrium_problem problem;
} setting;

static void hang(setting *s, const block *b)
{
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        double z = s->mesh.xyz[3 * (size_t)v + 2];
        if (z == 0) tie(&s->attach, v, SEGMENT_CRANIUM);
        if (z == b->size[2]) tie(&s->attach, v, SEGMENT_MAXILLA);
    }
}

static void set_up(setting *s, const block *b, double poisson, element_kind kind)
{
    err e = {0};
    *s = (setting){.mesh = block_mesh(b), .table = {{.region = REGION_ANY}}};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, poisson, &s->table[0].material, &e));
    assert_ok(element_choose(&s->table[0].material, kind, &e));
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    hang(s, b);
    s->problem =
        (equilibrium_problem){.mesh = &s->mesh, .attach = &s->attach, .materials = s->table, .material_count = 1};
    rest_motions(s->problem.motion);
}

/* Soft and stiff averaged layers, the stiff one without the logarithm, and a linear one, in bands along x. */
static void set_up_layers(setting *s, const block *b)
{
    err e = {0};
    static const double young[LAYERS] = {15, 3000, 60}, poisson[LAYERS] = {0.49, 0.45, 0.3};
    set_up(s, b, 0.49, ELEMENT_AVERAGED);
    s->problem.material_count = LAYERS;
    for (int k = 0; k < LAYERS; k++) {
        s->table[k].region = k;
        material *m = &s->table[k].material;
        assert_ok(material_make(k == 1 ? MATERIAL_SNH : MATERIAL_SNH_LOG, young[k], poisson[k], m, &e));
        assert_ok(element_choose(m, k == 2 ? ELEMENT_LINEAR : ELEMENT_AVERAGED, &e));
    }
    for (int32_t t = 0; t < s->mesh.tet_count; t++) s->mesh.region[t] = t / b->tets % b->nx * LAYERS / b->nx;
}

static void tear_down(setting *s)
{
    tetmesh_free(&s->mesh);
    attach_map_free(&s->attach);
}

/* Rest moved by up to 0.3 mm. */
static double *shaken(const setting *s, uint64_t seed)
{
    size_t n = 3 * (size_t)s->mesh.vertex_count;
    double *x = COPY_ARRAY(double, s->mesh.xyz, n);
    for (size_t i = 0; i < n; i++) x[i] += 0.3 * block_random(&seed);
    return x;
}

static void check_derivatives(const setting *s)
{
    err e = {0};
    solver *t = NULL;
    assert_ok(solver_create(&s->problem, 1, &t, &e));
    size_t n = 3 * (size_t)s->mesh.vertex_count;
    double *x = shaken(s, 4), *w = NEW_ARRAY(double, n), *y = NEW_ARRAY(double, n);
    double *f[2] = {NEW_ARRAY(double, n), NEW_ARRAY(double, n)}, *Kw = NEW_ARRAY(double, n), h = 1e-5;
    uint64_t seed = 5;
    for (size_t i = 0; i < n; i++) w[i] = block_random(&seed);
    assembly_stiffness(&t->a, x, PROJECTION_NONE);
    assembly_multiply(&t->a, w, Kw);
    double energy[2], scale = 0, slope = 0;
    for (int side = 0; side < 2; side++) {
        for (size_t i = 0; i < n; i++) y[i] = x[i] + (side ? -h : h) * w[i];
        energy[side] = assembly_energy(&t->a, y, f[side]);
    }
    for (size_t i = 0; i < n; i++) scale = fmax(scale, fabs(Kw[i]));
    for (size_t i = 0; i < n; i++) {
        assert_near((f[0][i] - f[1][i]) / (2 * h), Kw[i], 1e-7 * scale);
        slope += (f[0][i] + f[1][i]) / 2 * w[i];
    }
    assert_near((energy[0] - energy[1]) / (2 * h), slope, 1e-7 * fabs(slope));
    free(x);
    free(w);
    free(y);
    free(f[0]);
    free(f[1]);
    free(Kw);
    solver_destroy(&t);
}

static void forces_and_stiffness_are_derivatives(void **state)
{
    (void)state;
    setting s;
    block b = {3, 3, 3, {6, 5, 7}, 5, 0.2};
    set_up(&s, &b, 0.49, ELEMENT_AVERAGED);
    check_derivatives(&s);
    tear_down(&s);
    block wide = {6, 3, 3, {12, 5, 7}, 5, 0.2};
    set_up_layers(&s, &wide);
    check_derivatives(&s);
    tear_down(&s);
}

static double shaken_energy(const setting *s)
{
    err e = {0};
    solver *t = NULL;
    assert_ok(solver_create(&s->problem, 1, &t, &e));
    double *x = shaken(s, 4), energy = assembly_energy(&t->a, x, NULL);
    free(x);
    solver_destroy(&t);
    return energy;
}

/* With everything else next to nothing each material has the energy that it adds to the whole. */
static void materials_do_not_share_an_average(void **state)
{
    (void)state;
    setting s;
    block b = {6, 3, 3, {12, 5, 7}, 5, 0.2};
    set_up_layers(&s, &b);
    double whole = shaken_energy(&s), sum = 0;
    for (int k = 0; k < LAYERS; k++) {
        setting one = s;
        one.problem.materials = one.table;
        for (int j = 0; j < LAYERS; j++) {
            material *m = &one.table[j].material;
            if (j == k) continue;
            m->mu_kpa *= 1e-14;
            m->lambda_kpa *= 1e-14;
            m->averaged_kpa *= 1e-14;
        }
        sum += shaken_energy(&one);
    }
    assert_near(sum, whole, 1e-11 * whole);
    tear_down(&s);
}

/* Where every tet has the same F the averages change nothing; a rigid motion costs nothing. */
static void an_affine_field_has_the_forces_of_the_plain_element(void **state)
{
    (void)state;
    err e = {0};
    static const double A[9] = {1.2, 0.1, -0.05, 0.15, 0.9, 0.2, -0.1, 0.05, 1.1};
    rigid turn = rigid_rotation((double[]){1, 2, 3}, (double[]){1, 2, -1}, 2);
    block b = {3, 4, 3, {6, 5, 7}, 6, 0.2};
    setting s[2];
    solver *t[2] = {NULL, NULL};
    for (int k = 0; k < 2; k++) {
        set_up_layers(&s[k], &b);
        for (int j = 0; j < LAYERS && k == 0; j++)
            assert_ok(element_choose(&s[k].table[j].material, ELEMENT_LINEAR, &e));
        s[k].problem.materials = s[k].table;
        s[k].problem.mesh = &s[k].mesh;
        s[k].problem.attach = &s[k].attach;
        assert_ok(solver_create(&s[k].problem, 1, &t[k], &e));
        assert_true((t[k]->a.average != NULL) == (k == 1));
    }
    size_t n = 3 * (size_t)s[0].mesh.vertex_count;
    double *x = NEW_ARRAY(double, n), *f[2] = {NEW_ARRAY(double, n), NEW_ARRAY(double, n)}, energy[2];
    for (size_t i = 0; i < n; i += 3) mat_apply(A, s[0].mesh.xyz + i, x + i);
    for (int k = 0; k < 2; k++) energy[k] = assembly_energy(&t[k]->a, x, f[k]);
    assert_near(energy[0], energy[1], 1e-10 * energy[0]);
    for (size_t i = 0; i < n; i++) assert_near(f[0][i], f[1][i], 1e-8);
    for (size_t i = 0; i < n; i += 3) rigid_apply(&turn, s[0].mesh.xyz + i, x + i);
    assert_near(assembly_energy(&t[1]->a, x, f[1]), 0, 1e-10);
    for (size_t i = 0; i < n; i++) assert_near(f[1][i], 0, 1e-8);
    free(x);
    free(f[0]);
    free(f[1]);
    for (int k = 0; k < 2; k++) {
        solver_destroy(&t[k]);
        tear_down(&s[k]);
    }
}

static void threads_do_not_change_a_bit(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    solver *t = NULL;
    block b = {12, 9, 9, {24, 18, 18}, 5, 0.2};
    const int threads[] = {1, 2, 3, 8};
    set_up_layers(&s, &b);
    assert_ok(solver_create(&s.problem, 1, &t, &e));
    size_t n = 3 * (size_t)s.mesh.vertex_count, block_doubles = 9 * (size_t)t->a.edge_count;
    double *x = shaken(&s, 4), *f = NEW_ARRAY(double, n), *f_one = NULL, *k_one = NULL, energy_one = 0;
    for (int k = 0; k < 4; k++) {
        parallel_set_threads(threads[k]);
        double energy = assembly_energy(&t->a, x, f);
        assembly_stiffness(&t->a, x, PROJECTION_CLAMP);
        if (k == 0) {
            energy_one = energy;
            f_one = COPY_ARRAY(double, f, n);
            k_one = COPY_ARRAY(double, t->a.edge_block, block_doubles);
            continue;
        }
        assert_memory_equal(&energy, &energy_one, sizeof energy);
        assert_memory_equal(f, f_one, n * sizeof *f);
        assert_memory_equal(t->a.edge_block, k_one, block_doubles * sizeof *k_one);
    }
    parallel_set_threads(0);
    free(x);
    free(f);
    free(f_one);
    free(k_one);
    solver_destroy(&t);
    tear_down(&s);
}

/* The multigrid has to cope with second neighbours and with a contrast of 200. */
static void gradients_and_factors_agree(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    block b = {12, 9, 9, {24, 18, 18}, 5, 0.1};
    equilibrium q[2];
    set_up_layers(&s, &b);
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){1, 2, 2});
    for (int k = 0; k < 2; k++) {
        solve_params params = solve_params_default();
        params.rel_tol = 1e-10;
        params.linear = k ? LINEAR_GRADIENTS : LINEAR_FACTOR;
        assert_ok(equilibrium_solve(&s.problem, &params, &q[k], &e));
        assert_int_equal(q[k].outcome, SOLVED);
    }
    print_message("%lld unknowns, averaged and linear layers: factors %d iterations, gradients %d with %d of their own "
                  "and %d preconditioners\n",
                  (long long)q[0].unknown_count, q[0].iterations, q[1].iterations, q[1].cg_iterations,
                  q[1].preconditioners);
    assert_true(q[1].factorisations == 0 && q[1].preconditioners > 0);
    for (int32_t i = 0; i < 3 * q[0].node_count; i++) assert_near(q[0].xyz[i], q[1].xyz[i], 1e-6);
    equilibrium_free(&q[0]);
    equilibrium_free(&q[1]);
    tear_down(&s);
}

/* Energy of a block pressed by 10 %: near incompressibility locking makes it far too high. */
static double pressed_energy(int cells, double poisson, element_kind kind)
{
    err e = {0};
    setting s;
    block b = {2 * cells, 2 * cells, cells, {20, 20, 10}, 6, 0};
    set_up(&s, &b, poisson, kind);
    s.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -1});
    solve_params params = solve_params_default();
    equilibrium q;
    assert_ok(equilibrium_solve(&s.problem, &params, &q, &e));
    assert_int_equal(q.outcome, SOLVED);
    double out = q.energy_uj;
    equilibrium_free(&q);
    tear_down(&s);
    return out;
}

static void averages_lock_less_near_incompressibility(void **state)
{
    (void)state;
    static const double poisson[] = {0.45, 0.49, 0.499};
    for (int n = 0; n < 3; n++) {
        double p[3], q[3];
        for (int k = 0; k < 3; k++) {
            p[k] = pressed_energy(2 << k, poisson[n], ELEMENT_LINEAR);
            q[k] = pressed_energy(2 << k, poisson[n], ELEMENT_AVERAGED);
        }
        double fine = q[2]; /* below every plain energy, which are upper bounds of the true one */
        print_message("nu %.3f: reference %.1f uJ (averaged, 8 cells); error with 2, 4, 8 cells: plain %+.0f %+.0f "
                      "%+.0f %%, averaged %+.0f %+.0f %%\n",
                      poisson[n], fine, 100 * (p[0] / fine - 1), 100 * (p[1] / fine - 1), 100 * (p[2] / fine - 1),
                      100 * (q[0] / fine - 1), 100 * (q[1] / fine - 1));
        for (int k = 0; k < 3; k++) assert_true(q[k] < p[k]);
        assert_true(p[0] > p[1] && p[1] > p[2] && q[0] > q[1] && q[1] > q[2]);
        /* half the fineness is enough to beat the plain element */
        if (n > 0) assert_true(q[1] < p[2]);
    }
}

static void automatic_averages_where_it_pays(void **state)
{
    (void)state;
    err e = {0};
    material m;
    assert_ok(material_make(MATERIAL_NH_LN, 15, 0.49, &m, &e));
    assert_refused(element_choose(&m, ELEMENT_AVERAGED, &e), ERR_INPUT);
    assert_ok(element_choose(&m, ELEMENT_AUTO, &e));
    assert_true(m.averaged_kpa == 0);
    for (int below = 0; below < 2; below++) {
        assert_ok(material_make(MATERIAL_SNH, 15, element_average_from - 0.001 * below, &m, &e));
        assert_ok(element_choose(&m, ELEMENT_AUTO, &e));
        assert_true((m.averaged_kpa > 0) == !below);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_and_stiffness_are_derivatives),
        cmocka_unit_test(materials_do_not_share_an_average),
        cmocka_unit_test(an_affine_field_has_the_forces_of_the_plain_element),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(gradients_and_factors_agree),
        cmocka_unit_test(averages_lock_less_near_incompressibility),
        cmocka_unit_test(automatic_averages_where_it_pays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
