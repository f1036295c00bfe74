#include "tests/check.h"
#include "sim/element.h"
#include "sim/src/elastic/svd3.h"
#include "geometry/rigid.h"
#include "tests/physics/block.h"
#include "tests/physics/evidence.h"
#include <string.h>

static material make(material_model model, double poisson)
{
    err e = {0};
    material m;
    assert_ok(material_make(model, 15, model == MATERIAL_ARAP ? 0 : poisson, &m, &e));
    return m;
}

static bool may_invert(material_model model) { return model <= MATERIAL_SNH || model >= MATERIAL_IJ_COUNT; }

static const double poissons[] = {-0.3, 0, 0.3, 0.45, 0.49, 0.499};

/* Near rest, large, sheared, flattened, inverted; models without inversion get positive J only. */
static void some_F(uint64_t *seed, int which, bool inverted_too, double F[9])
{
    for (;;) {
        double size = which % 3 == 0 ? 1e-3 : which % 3 == 1 ? 0.3 : 1.6;
        for (int i = 0; i < 9; i++) F[i] = (i % 4 == 0) + size * block_random(seed);
        if (inverted_too || mat_det(F) > 0.2) return;
    }
}

static void forces_are_the_derivative_of_energy_and_hessian_of_forces(void **state)
{
    (void)state;
    uint64_t seed = 7;
    int inverted = 0;
    double worst = 0;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++)
        for (size_t p = 0; p < sizeof poissons / sizeof *poissons; p++)
            for (int n = 0; n < 12; n++) {
                material m = make((material_model)model, poissons[p]);
                double F[9], P[9], H[81], scale = m.mu_kpa + fabs(m.lambda_kpa), h = 1e-4;
                some_F(&seed, n, may_invert((material_model)model), F);
                inverted += mat_det(F) < 0;
                material_stress(&m, F, P);
                material_hessian(&m, F, H);
                for (int i = 0; i < 9; i++) {
                    /* fourth order differences: truncation and rounding both well below 1e-6 */
                    double psi[4], Q[4][9], at[4] = {-2 * h, -h, h, 2 * h};
                    for (int k = 0; k < 4; k++) {
                        double G[9];
                        memcpy(G, F, sizeof G);
                        G[i] += at[k];
                        psi[k] = material_energy(&m, G);
                        material_stress(&m, G, Q[k]);
                    }
                    double slope = (psi[0] - 8 * psi[1] + 8 * psi[2] - psi[3]) / (12 * h);
                    assert_near(keep_worst(&worst, (slope - P[i]) / scale), 0, 1e-6);
                    for (int j = 0; j < 9; j++) {
                        slope = (Q[0][j] - 8 * Q[1][j] + 8 * Q[2][j] - Q[3][j]) / (12 * h);
                        assert_near(keep_worst(&worst, (slope - H[9 * j + i]) / scale), 0, 1e-6);
                    }
                }
            }
    assert_true(inverted > 10);
    evidence("stress and stiffness of every material against differences of its energy, relative to mu + lambda", worst,
             "-");
}

static void rest_has_no_stress_and_no_energy_at_any_rotation(void **state)
{
    (void)state;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++)
        for (size_t p = 0; p < sizeof poissons / sizeof *poissons; p++) {
            material m = make((material_model)model, poissons[p]);
            double I[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, P[9];
            material_stress(&m, I, P);
            for (int i = 0; i < 9; i++) assert_near(P[i], 0, 1e-12 * m.mu_kpa);
            assert_near(material_energy(&m, I), 0, 0);
            rigid r = rigid_rotation((double[]){0, 0, 0}, (double[]){1, 2, -1}, 2.2);
            material_stress(&m, r.r, P);
            for (int i = 0; i < 9; i++) assert_near(P[i], 0, 1e-13 * (m.mu_kpa + fabs(m.lambda_kpa)));
        }
}

static void small_strains_obey_young_and_poisson(void **state)
{
    (void)state;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++)
        for (size_t p = 0; p < sizeof poissons / sizeof *poissons; p++) {
            double nu = model == MATERIAL_ARAP ? 0 : poissons[p], P[9], s = 1e-6;
            material m = make((material_model)model, nu);
            double stretched[9] = {1 + s, 0, 0, 0, 1 - nu * s, 0, 0, 0, 1 - nu * s};
            material_stress(&m, stretched, P);
            double scale = (m.mu_kpa + fabs(m.lambda_kpa)) * s * 1e-5;
            assert_near(P[0], 15 * s, scale);
            assert_near(P[4], 0, scale);
            double sheared[9] = {1, s, 0, 0, 1, 0, 0, 0, 1};
            material_stress(&m, sheared, P);
            assert_near(P[1], 15 / (2 * (1 + nu)) * s, scale);
        }
}

static void energy_does_not_see_rotations(void **state)
{
    (void)state;
    uint64_t seed = 3;
    rigid r = rigid_rotation((double[]){0, 0, 0}, (double[]){0.3, -1, 0.2}, 1.1);
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++)
        for (int n = 0; n < 9; n++) {
            material m = make((material_model)model, 0.45);
            double F[9], RF[9] = {0};
            some_F(&seed, n, may_invert((material_model)model), F);
            for (int i = 0; i < 9; i++)
                for (int k = 0; k < 3; k++) RF[i] += r.r[i / 3 * 3 + k] * F[3 * k + i % 3];
            assert_near(material_energy(&m, RF), material_energy(&m, F), 1e-11 * (m.mu_kpa + m.lambda_kpa));
        }
}

static double lowest_eigenvalue(const double H[81], double shift)
{
    /* inverse-free: Cholesky of H + shift succeeds exactly where the lowest eigenvalue exceeds -shift */
    double low = -1e6, high = 1e6;
    for (int k = 0; k < 80; k++) {
        double mid = (low + high) / 2, L[81] = {0};
        bool positive = true;
        for (int i = 0; i < 9 && positive; i++)
            for (int j = 0; j <= i && positive; j++) {
                double sum = H[9 * i + j] - (i == j ? mid : 0);
                for (int q = 0; q < j; q++) sum -= L[9 * i + q] * L[9 * j + q];
                if (i == j) positive = sum > 0;
                L[9 * i + j] = i == j ? sqrt(fmax(sum, 0)) : sum / L[10 * j];
            }
        if (positive)
            low = mid;
        else
            high = mid;
    }
    return low + shift;
}

static void projected_hessian_is_positive_and_keeps_what_was_positive(void **state)
{
    (void)state;
    uint64_t seed = 11;
    int changed = 0;
    for (int model = 0; model < MATERIAL_MODEL_COUNT; model++)
        for (int n = 0; n < 60; n++) {
            material m = make((material_model)model, poissons[n % 6]);
            double F[9], H[81], C[81], A[81], value[9], mode[9][9], scale = 0;
            some_F(&seed, n, may_invert((material_model)model), F);
            material_hessian(&m, F, H);
            material_hessian_projected(&m, F, PROJECTION_CLAMP, C);
            material_hessian_projected(&m, F, PROJECTION_ABS, A);
            for (int i = 0; i < 81; i++) scale = fmax(scale, fabs(H[i]));
            double low = lowest_eigenvalue(H, 0);
            assert_true(lowest_eigenvalue(C, 0) > -1e-10 * scale);
            assert_true(lowest_eigenvalue(A, 0) > -1e-10 * scale);
            if (model >= MATERIAL_IJ_COUNT) { /* numerical: compare what is taken away */
                double half = 0;
                for (int i = 0; i < 81; i++) half = fmax(half, fabs((H[i] + A[i]) / 2 - C[i]));
                assert_true(half < 1e-10 * scale);
                changed += low < 0;
                continue;
            }
            material_terms t = material_terms_at(&m, F);
            int count = material_negative_modes(&t, F, value, mode);
            double lowest = 0;
            for (int k = 0; k < count; k++) { /* true eigenpairs of H */
                lowest = fmin(lowest, value[k]);
                for (int i = 0; i < 9; i++) {
                    double sum = -value[k] * mode[k][i];
                    for (int j = 0; j < 9; j++) sum += H[9 * i + j] * mode[k][j];
                    assert_near(sum, 0, 1e-10 * scale);
                }
            }
            assert_near(fmin(low, 0), lowest, 1e-9 * scale);
            changed += count > 0;
        }
    assert_true(changed > 20);
}

static void shape_targeting_pulls_to_its_target(void **state)
{
    (void)state;
    static const double target[9] = {1.4, 0.2, -0.1, 0.2, 0.8, 0.15, -0.1, 0.15, 1.1};
    uint64_t seed = 21;
    rigid r = rigid_rotation((double[]){0, 0, 0}, (double[]){1, -2, 0.5}, 1.7);
    for (int model = MATERIAL_IJ_COUNT; model < MATERIAL_MODEL_COUNT; model++) {
        err e = {0};
        material m = make((material_model)model, 0.45);
        assert_ok(material_set_target(&m, target, &e));
        double RA[9] = {0}, P[9], scale = m.mu_kpa + m.lambda_kpa, h = 1e-4;
        for (int i = 0; i < 9; i++)
            for (int k = 0; k < 3; k++) RA[i] += r.r[i / 3 * 3 + k] * target[3 * k + i % 3];
        material_stress(&m, RA, P);
        for (int i = 0; i < 9; i++) assert_near(P[i], 0, 1e-13 * scale);
        assert_near(material_energy(&m, RA), 0, 1e-13 * scale);
        assert_true(material_energy(&m, r.r) > 0.1);
        for (int n = 0; n < 30; n++) {
            double F[9], H[81], Q[2][9], psi[2];
            some_F(&seed, n, n % 2, F);
            material_stress(&m, F, P);
            material_hessian(&m, F, H);
            for (int i = 0; i < 9; i++) {
                for (int side = 0; side < 2; side++) {
                    double G[9];
                    memcpy(G, F, sizeof G);
                    G[i] += side ? -h : h;
                    psi[side] = material_energy(&m, G);
                    material_stress(&m, G, Q[side]);
                }
                assert_near((psi[0] - psi[1]) / (2 * h), P[i], 1e-6 * scale);
                for (int j = 0; j < 9; j++) assert_near((Q[0][j] - Q[1][j]) / (2 * h), H[9 * j + i], 1e-6 * scale);
            }
            /* 2 mu Id majorises the Hessian of the part without volume */
            if (model != MATERIAL_ARAP) continue;
            for (int i = 0; i < 81; i++) H[i] = (i % 10 == 0 ? 2 * m.mu_kpa : 0) - H[i];
            assert_true(lowest_eigenvalue(H, 0) > -1e-10 * scale);
        }
        double skewed[9] = {1, 0.1, 0, 0, 1, 0, 0, 0, 1}, flat[9] = {1, 0, 0, 0, 1, 0, 0, 0, 0};
        assert_refused(material_set_target(&m, skewed, &e), ERR_INPUT);
        assert_refused(material_set_target(&m, flat, &e), ERR_INPUT);
    }
    err e = {0};
    material m = make(MATERIAL_SNH, 0.45);
    assert_refused(material_set_target(&m, target, &e), ERR_INPUT);
    assert_refused(material_make(MATERIAL_ARAP, 15, 0.3, &m, &e), ERR_INPUT);
}

static void refuses_constants_out_of_range(void **state)
{
    (void)state;
    err e = {0};
    material m;
    assert_refused(material_make(MATERIAL_SNH_LOG, 0, 0.45, &m, &e), ERR_INPUT);
    assert_refused(material_make(MATERIAL_SNH_LOG, nan(""), 0.45, &m, &e), ERR_INPUT);
    assert_refused(material_make(MATERIAL_SNH_LOG, 15, 0.5, &m, &e), ERR_INPUT);
    assert_refused(material_make(MATERIAL_SNH_LOG, 15, -1, &m, &e), ERR_INPUT);
    assert_refused(material_make(MATERIAL_SNH_LOG, 15, nan(""), &m, &e), ERR_INPUT);
    for (int i = 0; i < MATERIAL_MODEL_COUNT; i++)
        assert_int_equal(material_model_from_name(material_model_name((material_model)i)), i);
    assert_int_equal(material_model_from_name("rubber"), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_the_derivative_of_energy_and_hessian_of_forces),
        cmocka_unit_test(rest_has_no_stress_and_no_energy_at_any_rotation),
        cmocka_unit_test(small_strains_obey_young_and_poisson),
        cmocka_unit_test(energy_does_not_see_rotations),
        cmocka_unit_test(projected_hessian_is_positive_and_keeps_what_was_positive),
        cmocka_unit_test(shape_targeting_pulls_to_its_target),
        cmocka_unit_test(refuses_constants_out_of_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
