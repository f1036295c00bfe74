#include "geometry/rigid.h"
#include "geometry/vec.h"
#include <string.h>

rigid rigid_identity(void) { return (rigid){.r = {1, 0, 0, 0, 1, 0, 0, 0, 1}}; }

bool rigid_is_identity(const rigid *a)
{
    rigid id = rigid_identity();
    for (int i = 0; i < 9; i++)
        if (a->r[i] != id.r[i]) return false;
    return a->t[0] == 0 && a->t[1] == 0 && a->t[2] == 0;
}

void rigid_rotate(const rigid *a, const double v[3], double out[3])
{
    double y[3];
    mat_apply(a->r, v, y);
    vec_copy(y, out);
}

void rigid_apply(const rigid *a, const double x[3], double out[3])
{
    double y[3];
    mat_apply(a->r, x, y);
    vec_add(y, a->t, out);
}

rigid rigid_compose(const rigid *outer, const rigid *inner)
{
    rigid c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            c.r[3 * i + j] = 0;
            for (int k = 0; k < 3; k++) c.r[3 * i + j] += outer->r[3 * i + k] * inner->r[3 * k + j];
        }
    rigid_apply(outer, inner->t, c.t);
    return c;
}

rigid rigid_inverse(const rigid *a)
{
    rigid b;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) b.r[3 * i + j] = a->r[3 * j + i];
    double t[3];
    mat_apply(b.r, a->t, t);
    vec_scale(t, -1, b.t);
    return b;
}

rigid rigid_translation(const double t_mm[3])
{
    rigid a = rigid_identity();
    vec_copy(t_mm, a.t);
    return a;
}

rigid rigid_rotation(const double pivot[3], const double axis[3], double angle_rad)
{
    /* Rodrigues: R = c I + s [k]x + (1 - c) k k^T */
    double c = cos(angle_rad), s = sin(angle_rad), k[3];
    vec_copy(axis, k);
    vec_normalize(k);
    rigid a;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) a.r[3 * i + j] = (i == j ? c : 0) + (1 - c) * k[i] * k[j];
    a.r[1] -= s * k[2];
    a.r[2] += s * k[1];
    a.r[3] += s * k[2];
    a.r[5] -= s * k[0];
    a.r[6] -= s * k[1];
    a.r[7] += s * k[0];
    double moved[3];
    mat_apply(a.r, pivot, moved);
    vec_sub(pivot, moved, a.t);
    return a;
}

bool rigid_from_matrix(const double m[16], rigid *out, err *e)
{
    const double tol = 1e-6; /* what survives six printed digits */
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i])) return err_set(e, ERR_INPUT, "matrix entry %d is not a finite number", i);
    if (fabs(m[12]) > tol || fabs(m[13]) > tol || fabs(m[14]) > tol || fabs(m[15] - 1) > tol)
        return err_set(e, ERR_INPUT, "the last row of the matrix must be 0 0 0 1, got %g %g %g %g", m[12], m[13], m[14],
                       m[15]);
    double r[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) r[i][j] = m[4 * i + j];
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            double d = vec_dot(r[i], r[j]), want = i == j ? 1 : 0;
            if (fabs(d - want) > tol)
                return err_set(e, ERR_INPUT, "the matrix is not rigid: rows %d and %d have product %.9g, must be %g", i,
                               j, d, want);
        }
    /* Gram-Schmidt; rows are orthonormal to 1e-6 already */
    vec_normalize(r[0]);
    vec_axpy(r[1], -vec_dot(r[0], r[1]), r[0], r[1]);
    vec_normalize(r[1]);
    double third[3];
    vec_cross(r[0], r[1], third);
    if (vec_dot(third, r[2]) < 0) return err_set(e, ERR_INPUT, "the matrix mirrors (determinant -1)");
    rigid a;
    for (int j = 0; j < 3; j++) {
        a.r[j] = r[0][j];
        a.r[3 + j] = r[1][j];
        a.r[6 + j] = third[j];
        a.t[j] = m[4 * j + 3];
    }
    *out = a;
    return true;
}

void rigid_to_matrix(const rigid *a, double m[16])
{
    memset(m, 0, 16 * sizeof *m);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) m[4 * i + j] = a->r[3 * i + j];
        m[4 * i + 3] = a->t[i];
    }
    m[15] = 1;
}

double rigid_angle(const rigid *a)
{
    /* atan2 of the skew part and the trace: accurate near 0 and near pi */
    double s[3] = {a->r[7] - a->r[5], a->r[2] - a->r[6], a->r[3] - a->r[1]};
    return atan2(vec_norm(s), a->r[0] + a->r[4] + a->r[8] - 1);
}
