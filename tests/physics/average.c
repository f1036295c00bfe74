/* Averaged volume changes: derivatives, patch, rigid motion, and what they do about locking. */
#include "tests/check.h"
#include "sim/src/descent.h"
#include "tests/physics/block.h"
#include <string.h>

typedef struct setting {
    tetmesh mesh;
    attach_map attach;
    region_material table;
    equilibrium_problem problem;
} setting;

static void set_up(setting *s, const block *b, double poisson, bool average)
{
    err e = {0};
    *s = (setting){.mesh = block_mesh(b), .table = {REGION_ANY, {0}}};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, poisson, &s->table.material, &e));
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        double z = s->mesh.xyz[3 * (size_t)v + 2];
        if (z == 0) tie(&s->attach, v, SEGMENT_CRANIUM);
        if (z == b->size[2]) tie(&s->attach, v, SEGMENT_MAXILLA);
    }
    s->problem = (equilibrium_problem){.mesh = &s->mesh,
                                       .attach = &s->attach,
                                       .materials = &s->table,
                                       .material_count = 1,
                                       .average_volume = average};
    rest_motions(s->problem.motion);
}

static void tear_down(setting *s)
{
    tetmesh_free(&s->mesh);
    attach_map_free(&s->attach);
}

static void forces_and_stiffness_are_derivatives(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    block b = {3, 3, 3, {6, 5, 7}, 5, 0.2};
    set_up(&s, &b, 0.49, true);
    solver *t = NULL;
    assert_ok(solver_create(&s.problem, 1, &t, &e));
    size_t n = 3 * (size_t)s.mesh.vertex_count;
    double *x = COPY_ARRAY(double, s.mesh.xyz, n), *w = NEW_ARRAY(double, n), *y = NEW_ARRAY(double, n);
    double *f[2] = {NEW_ARRAY(double, n), NEW_ARRAY(double, n)}, *Kw = NEW_ARRAY(double, n), h = 1e-5;
    uint64_t seed = 4;
    for (size_t i = 0; i < n; i++) {
        x[i] += 0.3 * block_random(&seed);
        w[i] = block_random(&seed);
    }
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
        set_up(&s[k], &b, 0.49, k == 1);
        assert_ok(solver_create(&s[k].problem, 1, &t[k], &e));
    }
    size_t n = 3 * (size_t)s[0].mesh.vertex_count;
    double *x = NEW_ARRAY(double, n), *f[2] = {NEW_ARRAY(double, n), NEW_ARRAY(double, n)}, energy[2];
    for (size_t i = 0; i < n; i += 3) mat_apply(A, s[0].mesh.xyz + i, x + i);
    for (int k = 0; k < 2; k++) energy[k] = assembly_energy(&t[k]->a, x, f[k]);
    assert_near(energy[0], energy[1], 1e-10 * energy[0]);
    for (size_t i = 0; i < n; i++) assert_near(f[0][i], f[1][i], 1e-9);
    for (size_t i = 0; i < n; i += 3) rigid_apply(&turn, s[0].mesh.xyz + i, x + i);
    assert_near(assembly_energy(&t[1]->a, x, f[1]), 0, 1e-10);
    for (size_t i = 0; i < n; i++) assert_near(f[1][i], 0, 1e-9);
    free(x);
    free(f[0]);
    free(f[1]);
    for (int k = 0; k < 2; k++) {
        solver_destroy(&t[k]);
        tear_down(&s[k]);
    }
}

/* Energy of a block pressed by 10 %: near incompressibility locking makes it far too high. */
static double pressed_energy(int cells, double poisson, bool average)
{
    err e = {0};
    setting s;
    block b = {2 * cells, 2 * cells, cells, {20, 20, 10}, 6, 0};
    set_up(&s, &b, poisson, average);
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
            p[k] = pressed_energy(2 << k, poisson[n], false);
            q[k] = pressed_energy(2 << k, poisson[n], true);
        }
        double fine = q[2]; /* below every plain energy, which are upper bounds of the true one */
        print_message(
            "nu %.3f: reference %.1f uJ (averaged, 8 cells); error with 2, 4, 8 cells: plain %+.0f %+.0f "
            "%+.0f %%, averaged %+.0f %+.0f %%\n",
            poisson[n], fine, 100 * (p[0] / fine - 1), 100 * (p[1] / fine - 1), 100 * (p[2] / fine - 1),
            100 * (q[0] / fine - 1), 100 * (q[1] / fine - 1));
        for (int k = 0; k < 3; k++) assert_true(q[k] < p[k]);
        assert_true(p[0] > p[1] && p[1] > p[2] && q[0] > q[1] && q[1] > q[2]);
        /* half the fineness is enough to beat the plain element */
        if (n > 0) assert_true(q[1] < p[2]);
    }
}

static void what_cannot_be_averaged_is_refused(void **state)
{
    (void)state;
    err e = {0};
    setting s;
    block b = {2, 2, 2, {6, 5, 7}, 6, 0};
    set_up(&s, &b, 0.49, true);
    solver *t = NULL;
    s.table.material.model = MATERIAL_NH_LN;
    assert_refused(solver_create(&s.problem, 1, &t, &e), ERR_INPUT);
    region_material two[2] = {s.table, {0, s.table.material}};
    s.problem.materials = two;
    s.problem.material_count = 2;
    assert_refused(solver_create(&s.problem, 1, &t, &e), ERR_INPUT);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_and_stiffness_are_derivatives),
        cmocka_unit_test(an_affine_field_has_the_forces_of_the_plain_element),
        cmocka_unit_test(averages_lock_less_near_incompressibility),
        cmocka_unit_test(what_cannot_be_averaged_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
