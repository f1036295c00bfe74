#include "sim/src/elastic/shape.h"
#include "geometry/vec.h"
#include "sim/src/elastic/svd3.h"
#include <string.h>

bool material_set_target(material *m, const double A[9], err *e)
{
    if (m->model < MATERIAL_IJ_COUNT)
        return err_set(e, ERR_INPUT, "%s takes no target shape", material_model_name(m->model));
    double copy[9], value[3], Q[9];
    for (int i = 0; i < 9; i++)
        if (!isfinite(A[i]) || A[i] != A[3 * (i % 3) + i / 3])
            return err_set(e, ERR_INPUT, "the target shape is not symmetric");
    memcpy(copy, A, sizeof copy);
    symmetric_eigen(3, copy, value, Q);
    for (int k = 0; k < 3; k++)
        if (!(value[k] > 0))
            return err_set(e, ERR_INPUT, "the target shape has the stretch %g, which is not > 0", value[k]);
    memcpy(m->target, A, sizeof m->target);
    m->target_j = mat_det(A);
    return true;
}

static void multiply(const double a[9], const double b[9], double out[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

/* The rotation nearest to F A: |F - R A| is least where R maximises <R, F A>. */
static void nearest_rotation(const double U[9], const double V[9], double R[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) R[3 * i + j] = vec_dot(U + 3 * i, V + 3 * j);
}

static double lambda_of(const material *m) { return m->model == MATERIAL_ARAP ? 0 : m->lambda_kpa; }

double shape_energy(const material *m, const double F[9], double P[9])
{
    double M[9], U[9], s[3], V[9], R[9], RA[9], C[9], square = 0;
    multiply(F, m->target, M);
    svd3(M, U, s, V);
    nearest_rotation(U, V, R);
    multiply(R, m->target, RA);
    double bulk = lambda_of(m) * (mat_det(F) - m->target_j);
    for (int i = 0; i < 9; i++) square += (F[i] - RA[i]) * (F[i] - RA[i]);
    if (P) {
        material_cofactor(F, C);
        for (int i = 0; i < 9; i++) P[i] = 2 * m->mu_kpa * (F[i] - RA[i]) + bulk * C[i];
    }
    return m->mu_kpa * square + bulk / 2 * (mat_det(F) - m->target_j);
}

/* No closed eigensystem for A other than the identity: the projection is numerical. */
static void project(projection how, double H[81])
{
    double copy[81], value[9], Q[81];
    memcpy(copy, H, sizeof copy);
    symmetric_eigen(9, copy, value, Q);
    for (int k = 0; k < 9; k++) {
        if (!(value[k] < 0)) continue;
        double lift = (how == PROJECTION_ABS ? -2 : -1) * value[k];
        for (int i = 0; i < 9; i++)
            for (int j = 0; j < 9; j++) H[9 * i + j] += lift * Q[9 * i + k] * Q[9 * j + k];
    }
}

void shape_hessian(const material *m, const double F[9], projection how, double H[81])
{
    double M[9], U[9], s[3], V[9], C[9], la = lambda_of(m);
    multiply(F, m->target, M);
    svd3(M, U, s, V);
    material_cofactor(F, C);
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 9; j++) H[9 * i + j] = la * C[i] * C[j] + (i == j ? 2 * m->mu_kpa : 0);
    for (int q = 0; q < 3; q++) { /* R turns about three axes: dR = sum 2/(s_i + s_j) twist <twist, dF A> */
        int i = (q + 1) % 3, j = (q + 2) % 3;
        double twist[9], w[9], turn = 2 / fmax(s[i] + s[j], 1e-6);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                twist[3 * r + c] = (U[3 * r + j] * V[3 * c + i] - U[3 * r + i] * V[3 * c + j]) * sqrt(0.5);
        multiply(twist, m->target, w);
        for (int r = 0; r < 9; r++)
            for (int c = 0; c < 9; c++) H[9 * r + c] -= 2 * m->mu_kpa * turn * w[r] * w[c];
    }
    double bulk = la * (mat_det(F) - m->target_j);
    for (int r = 0; r < 9; r++)
        for (int c = 0; c < 9; c++) { /* d2J / dF_ij dF_kl = eps_ikm eps_jln F_mn */
            int i = r / 3, j = r % 3, k = c / 3, l = c % 3;
            if (i == k || j == l) continue;
            double sign = ((k - i + 3) % 3 == 1) == ((l - j + 3) % 3 == 1) ? 1 : -1;
            H[9 * r + c] += bulk * sign * F[3 * (3 - i - k) + 3 - j - l];
        }
    if (how != PROJECTION_NONE) project(how, H);
}
