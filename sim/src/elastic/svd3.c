#include "sim/src/elastic/svd3.h"
#include "geometry/vec.h"
#include <string.h>

/* Some unit vector across a. */
static void any_normal(const double a[3], double out[3])
{
    int small = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(a[c]) < fabs(a[small])) small = c;
    double axis[3] = {0};
    axis[small] = 1;
    vec_cross(a, axis, out);
    vec_normalize(out);
}

void svd3(const double F[9], double U[9], double s[3], double V[9])
{
    double b[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; /* columns of F V and of V */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) b[j][i] = F[3 * i + j];
    for (int sweep = 0; sweep < 30; sweep++) {
        int turned = 0;
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                double x = vec_dot(b[p], b[p]), y = vec_dot(b[q], b[q]), z = vec_dot(b[p], b[q]);
                if (z * z <= 1e-32 * x * y || z == 0) continue;
                turned = 1;
                double zeta = (y - x) / (2 * z);
                double t = (zeta >= 0 ? 1 : -1) / (fabs(zeta) + sqrt(1 + zeta * zeta));
                double c = 1 / sqrt(1 + t * t), sn = c * t;
                for (int i = 0; i < 3; i++) {
                    double bp = b[p][i], vp = v[p][i];
                    b[p][i] = c * bp - sn * b[q][i];
                    b[q][i] = sn * bp + c * b[q][i];
                    v[p][i] = c * vp - sn * v[q][i];
                    v[q][i] = sn * vp + c * v[q][i];
                }
            }
        if (!turned) break;
    }
    double length[3] = {vec_norm(b[0]), vec_norm(b[1]), vec_norm(b[2])};
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2 - i; j++)
            if (length[order[j]] < length[order[j + 1]]) {
                int k = order[j];
                order[j] = order[j + 1];
                order[j + 1] = k;
            }
    double u[3][3], w[3][3];
    vec_copy(v[order[0]], w[0]);
    vec_copy(v[order[1]], w[1]);
    vec_cross(w[0], w[1], w[2]); /* +-v[order[2]], making V a rotation */
    s[0] = length[order[0]];
    s[1] = length[order[1]];
    if (s[0] > 0)
        vec_scale(b[order[0]], 1 / s[0], u[0]);
    else
        vec_copy((const double[3]){1, 0, 0}, u[0]);
    if (s[1] > 1e-300) {
        vec_scale(b[order[1]], 1 / s[1], u[1]);
        vec_axpy(u[1], -vec_dot(u[0], u[1]), u[0], u[1]);
        if (!(vec_normalize(u[1]) > 0.5)) any_normal(u[0], u[1]);
    } else
        any_normal(u[0], u[1]);
    vec_cross(u[0], u[1], u[2]);
    double Fw[3];
    mat_apply(F, w[2], Fw);
    s[2] = vec_dot(u[2], Fw);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            U[3 * i + j] = u[j][i];
            V[3 * i + j] = w[j][i];
        }
}

void symmetric_eigen(int n, double *A, double *value, double *Q)
{
    memset(Q, 0, (size_t)(n * n) * sizeof *Q);
    for (int i = 0; i < n; i++) Q[n * i + i] = 1;
    for (int sweep = 0; sweep < 60; sweep++) {
        double off = 0, all = 0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                all += A[n * i + j] * A[n * i + j];
                if (i != j) off += A[n * i + j] * A[n * i + j];
            }
        if (off <= 1e-34 * all) break;
        for (int p = 0; p < n - 1; p++)
            for (int q = p + 1; q < n; q++) {
                double z = A[n * p + q];
                if (z == 0) continue;
                double zeta = (A[n * q + q] - A[n * p + p]) / (2 * z);
                double t = (zeta >= 0 ? 1 : -1) / (fabs(zeta) + sqrt(1 + zeta * zeta));
                double c = 1 / sqrt(1 + t * t), s = c * t;
                for (int k = 0; k < n; k++) {
                    double a = A[n * k + p];
                    A[n * k + p] = c * a - s * A[n * k + q];
                    A[n * k + q] = s * a + c * A[n * k + q];
                }
                for (int k = 0; k < n; k++) {
                    double a = A[n * p + k], h = Q[n * k + p];
                    A[n * p + k] = c * a - s * A[n * q + k];
                    A[n * q + k] = s * a + c * A[n * q + k];
                    Q[n * k + p] = c * h - s * Q[n * k + q];
                    Q[n * k + q] = s * h + c * Q[n * k + q];
                }
            }
    }
    for (int i = 0; i < n; i++) value[i] = A[n * i + i];
}
