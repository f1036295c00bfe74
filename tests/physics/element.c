/* Single tetrahedra, and the decomposition under them. */
#include "tests/check.h"
#include "sim/element.h"
#include "sim/src/elastic/svd3.h"
#include "tests/physics/block.h"
#include <string.h>

static material make(material_model model, double poisson)
{
    err e = {0};
    material m;
    assert_ok(material_make(model, 15, model == MATERIAL_ARAP ? 0 : poisson, &m, &e));
    return m;
}

static bool may_invert(material_model model) { return model <= MATERIAL_SNH || model >= MATERIAL_IJ_COUNT; }

static void element_forces_and_stiffness_are_derivatives(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++) {
        err e = {0};
        region_material table = {0, make((material_model)model, 0.45)};
        block b = {1, 1, 1, {3, 4, 2}, 5, 0};
        tetmesh mesh = block_mesh(&b);
        elements el;
        assert_ok(elements_make(&mesh, &table, 1, &el, &e));
        double x[12], f[12], K[9 * ELEMENT_PAIRS], h = 1e-4;
        for (int k = 0; k < 12; k++)
            x[k] = mesh.xyz[3 * mesh.tet[k / 3] + k % 3] +
                   (may_invert((material_model)model) ? 1.5 : 0.3) * block_random(&seed);
        const material *m = &el.materials[0];
        element_energy(m, el.gradient, el.volume[0], x, f);
        element_stiffness(m, el.gradient, el.volume[0], x, PROJECTION_NONE, K);
        double scale = (m->mu_kpa + m->lambda_kpa) * 4;
        for (int k = 0; k < 12; k++) {
            double y[12], fp[12], fm[12];
            memcpy(y, x, sizeof y);
            y[k] = x[k] + h;
            double up = element_energy(m, el.gradient, el.volume[0], y, fp);
            y[k] = x[k] - h;
            double down = element_energy(m, el.gradient, el.volume[0], y, fm);
            assert_near((up - down) / (2 * h), f[k], 1e-6 * scale);
            for (int p = 0; p < ELEMENT_PAIRS; p++)
                for (int i = 0; i < 3; i++)
                    if (element_pair[p][1] == k / 3) {
                        int row = 3 * element_pair[p][0] + i;
                        assert_near((fp[row] - fm[row]) / (2 * h), K[9 * p + 3 * i + k % 3], 1e-6 * scale);
                    }
        }
        /* the clamped blocks equal V B^T H_clamped B */
        double F[9], H[81];
        element_gradient_F(el.gradient, x, F);
        material_hessian_projected(m, F, PROJECTION_CLAMP, H);
        element_stiffness(m, el.gradient, el.volume[0], x, PROJECTION_CLAMP, K);
        for (int p = 0; p < ELEMENT_PAIRS; p++)
            for (int i = 0; i < 9; i++) {
                double sum = 0;
                for (int r = 0; r < 3; r++)
                    for (int s = 0; s < 3; s++)
                        sum += el.volume[0] * el.gradient[3 * element_pair[p][0] + r] *
                               H[9 * (3 * (i / 3) + r) + 3 * (i % 3) + s] * el.gradient[3 * element_pair[p][1] + s];
                assert_near(K[9 * p + i], sum, 1e-11 * scale);
            }
        elements_free(&el);
        tetmesh_free(&mesh);
    }
}

static void svd_rebuilds_flat_and_mirrored_matrices(void **state)
{
    (void)state;
    uint64_t seed = 9;
    for (int n = 0; n < 60; n++) {
        double F[9], U[9], s[3], V[9];
        for (int i = 0; i < 9; i++) F[i] = block_random(&seed);
        if (n % 4 == 1) vec_axpy(F, 1e-9, F + 3, F + 6);                 /* rank two, nearly */
        if (n % 4 == 2) vec_scale(F, 2, F + 3), vec_scale(F, -1, F + 6); /* rank one */
        if (n == 3) memset(F, 0, sizeof F);
        svd3(F, U, s, V);
        assert_near(mat_det(U), 1, 1e-13);
        assert_near(mat_det(V), 1, 1e-13);
        assert_true(s[0] >= s[1] && s[1] >= fabs(s[2]) - 1e-15);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double sum = 0, uu = 0;
                for (int k = 0; k < 3; k++)
                    sum += U[3 * i + k] * s[k] * V[3 * j + k], uu += U[3 * k + i] * U[3 * k + j];
                assert_near(sum, F[3 * i + j], 1e-14);
                assert_near(uu, i == j, 1e-13);
            }
    }
}

static void a_region_without_material_is_refused(void **state)
{
    (void)state;
    err e = {0};
    block b = {1, 1, 1, {1, 1, 1}, 6, 0};
    tetmesh mesh = block_mesh(&b);
    elements el;
    region_material table[2] = {{0, make(MATERIAL_SNH, 0.3)}, {0, make(MATERIAL_SNH, 0.4)}};
    assert_refused(elements_make(&mesh, table, 2, &el, &e), ERR_INPUT);
    mesh.region[3] = 7;
    assert_refused(elements_make(&mesh, table, 1, &el, &e), ERR_INPUT);
    table[1].region = REGION_ANY;
    assert_ok(elements_make(&mesh, table, 2, &el, &e));
    assert_int_equal(el.material[0], 0);
    assert_int_equal(el.material[3], 1);
    elements_free(&el);
    tetmesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(element_forces_and_stiffness_are_derivatives),
        cmocka_unit_test(svd_rebuilds_flat_and_mirrored_matrices),
        cmocka_unit_test(a_region_without_material_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
