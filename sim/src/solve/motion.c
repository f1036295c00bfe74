#include "sim/motion.h"
#include "geometry/vec.h"
#include "sim/src/elastic/svd3.h"
#include <assert.h>

/* Unit axis of a rotation by `angle`. */
static void rotation_axis(const double r[9], double angle, double axis[3])
{
    double skew[3] = {r[7] - r[5], r[2] - r[6], r[3] - r[1]};
    vec_copy(skew, axis);
    if (angle < 3) {
        vec_normalize(axis);
        return;
    }
    /* near pi the skew part fades: the longest column of (R + R^T)/2 - cos I = (1 - cos) k k^T */
    double c = cos(angle), best = -1;
    for (int j = 0; j < 3; j++) {
        double column[3];
        for (int i = 0; i < 3; i++) column[i] = (r[3 * i + j] + r[3 * j + i]) / 2 - (i == j ? c : 0);
        double length = vec_norm(column);
        if (length <= best) continue;
        best = length;
        vec_copy(column, axis);
    }
    vec_normalize(axis);
    if (vec_dot(axis, skew) < 0) vec_scale(axis, -1, axis);
}

/* out = V(angle) v with V = integral of the rotation over the way: the translation of a screw of unit
 * velocity v. Murray, Li, Sastry 1994, eq. 2.36. */
static void integrate(const double axis[3], double angle, const double v[3], double out[3])
{
    double a[3], b[3];
    vec_cross(axis, v, a);
    vec_cross(axis, a, b);
    double half = sin(angle / 2);
    for (int c = 0; c < 3; c++) out[c] = v[c] + 2 * half * half / angle * a[c] + (angle - sin(angle)) / angle * b[c];
}

rigid motion_part(const rigid *whole, double s)
{
    assert(s >= 0 && s <= 1);
    if (s == 0) return rigid_identity();
    if (s == 1) return *whole;
    double angle = rigid_angle(whole), t[3];
    if (angle < 1e-9) { /* rotation over a head below 1e-6 mm: t in proportion, R linear */
        rigid part = *whole;
        for (int i = 0; i < 9; i++) part.r[i] = (i % 4 == 0) + s * (whole->r[i] - (i % 4 == 0));
        vec_scale(whole->t, s, part.t);
        return part;
    }
    double axis[3], velocity[3], a[3], b[3];
    rotation_axis(whole->r, angle, axis);
    /* V^-1 t = t - angle/2 k x t + (1 - angle/2 cot(angle/2)) k x k x t */
    vec_cross(axis, whole->t, a);
    vec_cross(axis, a, b);
    double half = angle / 2, w = 1 - half / tan(half);
    if (angle < 1e-3) w = angle * angle / 12; /* next term below 1e-15 */
    for (int c = 0; c < 3; c++) velocity[c] = whole->t[c] - half * a[c] + w * b[c];
    integrate(axis, s * angle, velocity, t);
    rigid part = rigid_rotation((const double[3]){0, 0, 0}, axis, s * angle);
    vec_scale(t, s, part.t);
    return part;
}

rigid motion_fit(const double *from, const double *to, int64_t count)
{
    /* Kabsch 1976: R from the polar decomposition of the covariance. */
    if (count == 0) return rigid_identity();
    double a[3] = {0}, b[3] = {0}, cov[9] = {0}, U[9], s[3], V[9];
    for (int64_t k = 0; k < count; k++)
        for (int c = 0; c < 3; c++) {
            a[c] += from[3 * k + c] / (double)count;
            b[c] += to[3 * k + c] / (double)count;
        }
    for (int64_t k = 0; k < count; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) cov[3 * i + j] += (to[3 * k + i] - b[i]) * (from[3 * k + j] - a[j]);
    rigid fit = rigid_identity();
    svd3(cov, U, s, V);
    if (s[1] > 1e-12 * s[0])
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                fit.r[3 * i + j] = 0;
                for (int k = 0; k < 3; k++) fit.r[3 * i + j] += U[3 * i + k] * V[3 * j + k];
            }
    double moved[3];
    mat_apply(fit.r, a, moved);
    vec_sub(b, moved, fit.t);
    return fit;
}
