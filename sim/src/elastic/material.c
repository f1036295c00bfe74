#include "sim/material.h"
#include "geometry/vec.h"
#include "sim/src/elastic/shape.h"
#include "sim/src/elastic/svd3.h"
#include <assert.h>
#include <string.h>

static const char *const model_names[MATERIAL_MODEL_COUNT] = {"snhlog", "snh", "nhln", "nhiso", "fcr", "arap"};

const char *material_model_name(material_model model)
{
    assert(model < MATERIAL_MODEL_COUNT);
    return model_names[model];
}

int material_model_from_name(const char *name)
{
    for (int i = 0; i < MATERIAL_MODEL_COUNT; i++)
        if (strcmp(name, model_names[i]) == 0) return i;
    return -1;
}

bool material_make(material_model model, double young_kpa, double poisson, material *out, err *e)
{
    assert(model < MATERIAL_MODEL_COUNT);
    if (!(young_kpa > 0) || !isfinite(young_kpa))
        return err_set(e, ERR_INPUT, "young_kpa must be > 0, got %g", young_kpa);
    if (!(poisson > -1) || !(poisson < 0.5))
        return err_set(e, ERR_INPUT, "poisson must lie between -1 and 0.5, both excluded, got %g", poisson);
    if (model == MATERIAL_ARAP && poisson != 0)
        return err_set(e, ERR_INPUT, "poisson of arap must be 0, got %g", poisson);
    double mu = young_kpa / (2 * (1 + poisson));
    double lambda = young_kpa * poisson / ((1 + poisson) * (1 - 2 * poisson));
    material m = {.model = model,
                  .young_kpa = young_kpa,
                  .poisson = poisson,
                  .mu_kpa = mu,
                  .lambda_kpa = lambda,
                  .target = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                  .target_j = 1};
    switch (model) {
    case MATERIAL_SNH_LOG:
        m.mu_kpa = 4.0 / 3.0 * mu;
        m.lambda_kpa = lambda + 5.0 / 6.0 * mu;
        break;
    case MATERIAL_SNH: m.lambda_kpa = lambda + mu; break;
    case MATERIAL_NH_ISO: m.lambda_kpa = lambda + 2.0 / 3.0 * mu; break; /* the bulk modulus */
    case MATERIAL_NH_LN:
    case MATERIAL_FIXED_COROTATED:
    case MATERIAL_ARAP: break;
    default: assert(0);
    }
    *out = m;
    return true;
}

material_terms material_terms_at(const material *m, const double F[9])
{
    /* I - 3 and J - 1 from F - 1: near rest the energy keeps its digits. */
    double h[9];
    memcpy(h, F, sizeof h);
    h[0] -= 1;
    h[4] -= 1;
    h[8] -= 1;
    double trace = h[0] + h[4] + h[8], square = 0;
    for (int i = 0; i < 9; i++) square += h[i] * h[i];
    double minors = h[0] * h[4] - h[1] * h[3] + h[0] * h[8] - h[2] * h[6] + h[4] * h[8] - h[5] * h[7];
    double i3 = 2 * trace + square, j1 = trace + minors + mat_det(h);
    double mu = m->mu_kpa, la = m->lambda_kpa;
    material_terms t = {0};
    switch (m->model) {
    case MATERIAL_SNH_LOG: { /* lambda (J - alpha) = lambda (J - 1) - 3/4 mu */
        double w = 1 / (i3 + 4);
        t.psi = mu / 2 * (i3 - log1p(i3 / 4)) + j1 * (la / 2 * j1 - 0.75 * mu + m->pressure_kpa);
        t.psi_i = mu / 2 * (1 - w);
        t.psi_ii = mu / 2 * w * w;
        t.psi_j = la * j1 - 0.75 * mu + m->pressure_kpa;
        t.psi_jj = la;
        break;
    }
    case MATERIAL_SNH:
        t.psi = mu / 2 * i3 + j1 * (la / 2 * j1 - mu + m->pressure_kpa);
        t.psi_i = mu / 2;
        t.psi_j = la * j1 - mu + m->pressure_kpa;
        t.psi_jj = la;
        break;
    case MATERIAL_NH_LN: {
        if (!(j1 > -1)) return (material_terms){.psi = HUGE_VAL};
        double ln = log1p(j1), J = 1 + j1;
        t.psi = mu / 2 * i3 - mu * ln + la / 2 * ln * ln;
        t.psi_i = mu / 2;
        t.psi_j = (la * ln - mu) / J;
        t.psi_jj = (la * (1 - ln) + mu) / (J * J);
        break;
    }
    case MATERIAL_NH_ISO: {
        if (!(j1 > -1)) return (material_terms){.psi = HUGE_VAL};
        double J = 1 + j1, I = 3 + i3, w = exp(-2.0 / 3.0 * log1p(j1));
        t.psi = mu / 2 * (w * i3 + 3 * expm1(-2.0 / 3.0 * log1p(j1))) + la / 2 * j1 * j1;
        t.psi_i = mu / 2 * w;
        t.psi_j = -mu / 3 * w * I / J + la * j1;
        t.psi_ij = -mu / 3 * w / J;
        t.psi_jj = mu * 5 / 9 * w * I / (J * J) + la;
        break;
    }
    default: assert(0);
    }
    return t;
}

void material_cofactor(const double F[9], double out[9])
{
    /* row i is the cross product of the other two rows */
    vec_cross(F + 3, F + 6, out);
    vec_cross(F + 6, F, out + 3);
    vec_cross(F, F + 3, out + 6);
}

double material_energy(const material *m, const double F[9])
{
    if (m->model >= MATERIAL_IJ_COUNT) return shape_energy(m, F, NULL);
    return material_terms_at(m, F).psi;
}

void material_stress(const material *m, const double F[9], double P[9])
{
    if (m->model >= MATERIAL_IJ_COUNT) {
        shape_energy(m, F, P);
        return;
    }
    material_terms t = material_terms_at(m, F);
    double C[9];
    material_cofactor(F, C);
    for (int i = 0; i < 9; i++) P[i] = 2 * t.psi_i * F[i] + t.psi_j * C[i];
}

static void add_outer(double scale, const double a[9], const double b[9], double H[81])
{
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 9; j++) H[9 * i + j] += scale * a[i] * b[j];
}

void material_hessian_projected(const material *m, const double F[9], projection how, double H[81])
{
    if (m->model >= MATERIAL_IJ_COUNT) {
        shape_hessian(m, F, how, H);
        return;
    }
    material_terms t = material_terms_at(m, F);
    double C[9];
    material_cofactor(F, C);
    memset(H, 0, 81 * sizeof *H);
    for (int i = 0; i < 9; i++) H[10 * i] = 2 * t.psi_i;
    add_outer(4 * t.psi_ii, F, F, H);
    add_outer(t.psi_jj, C, C, H);
    add_outer(2 * t.psi_ij, F, C, H);
    add_outer(2 * t.psi_ij, C, F, H);
    /* d2J / dF_ij dF_kl = eps_ikm eps_jln F_mn */
    static const int after[3] = {1, 2, 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = after[i], p = after[k], l = after[j], n = after[l];
            H[9 * (3 * i + j) + 3 * k + l] += t.psi_j * F[3 * p + n];
            H[9 * (3 * i + j) + 3 * p + n] += t.psi_j * F[3 * k + l];
            H[9 * (3 * i + j) + 3 * k + n] -= t.psi_j * F[3 * p + l];
            H[9 * (3 * i + j) + 3 * p + l] -= t.psi_j * F[3 * k + n];
        }
    if (how == PROJECTION_NONE) return;
    double value[9], mode[9][9];
    int count = material_negative_modes(&t, F, value, mode);
    for (int k = 0; k < count; k++) add_outer((how == PROJECTION_ABS ? -2 : -1) * value[k], mode[k], mode[k], H);
}

void material_hessian(const material *m, const double F[9], double H[81])
{
    material_hessian_projected(m, F, PROJECTION_NONE, H);
}

int material_negative_modes(const material_terms *t, const double F[9], double value[9], double mode[9][9])
{
    double U[9], s[3], V[9];
    svd3(F, U, s, V);
    int count = 0;
    for (int q = 0; q < 3; q++) {
        int i = (q + 1) % 3, j = (q + 2) % 3;
        for (int sign = -1; sign <= 1; sign += 2) { /* -1 twists, +1 flips */
            double lambda = 2 * t->psi_i - sign * t->psi_j * s[q];
            if (!(lambda < 0)) continue;
            value[count] = lambda;
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    mode[count][3 * r + c] =
                        (U[3 * r + j] * V[3 * c + i] + sign * U[3 * r + i] * V[3 * c + j]) * sqrt(0.5);
            count++;
        }
    }
    double A[9], w[3], Q[9], cof[3] = {s[1] * s[2], s[2] * s[0], s[0] * s[1]};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            A[3 * i + j] = 4 * t->psi_ii * s[i] * s[j] + t->psi_jj * cof[i] * cof[j] +
                           2 * t->psi_ij * (s[i] * cof[j] + s[j] * cof[i]);
            A[3 * i + j] += i == j ? 2 * t->psi_i : t->psi_j * s[3 - i - j];
        }
    if (A[0] > 0 && A[0] * A[4] > A[1] * A[1] && mat_det(A) > 0) return count; /* positive definite: none among these */
    symmetric_eigen(3, A, w, Q);
    for (int k = 0; k < 3; k++) {
        if (!(w[k] < 0)) continue;
        value[count] = w[k];
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) {
                double sum = 0;
                for (int i = 0; i < 3; i++) sum += U[3 * r + i] * Q[3 * i + k] * V[3 * c + i];
                mode[count][3 * r + c] = sum;
            }
        count++;
    }
    return count;
}
