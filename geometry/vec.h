/* vec: small maths on double[3] and row-major double[9]. Length unit mm, axes LPS (+x left, +y posterior,
 * +z superior). */
#pragma once
#include <math.h>
#ifdef __cplusplus
extern "C" {
#endif

static inline void vec_copy(const double a[3], double out[3])
{
    out[0] = a[0];
    out[1] = a[1];
    out[2] = a[2];
}
static inline void vec_sub(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = a[c] - b[c];
}
static inline void vec_add(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = a[c] + b[c];
}
/* out = a + s b */
static inline void vec_axpy(const double a[3], double s, const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = a[c] + s * b[c];
}
static inline void vec_scale(const double a[3], double s, double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = s * a[c];
}
static inline double vec_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/* out may not alias a or b */
static inline void vec_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}
static inline double vec_norm(const double a[3]) { return sqrt(vec_dot(a, a)); }
static inline double vec_distance(const double a[3], const double b[3])
{
    double d[3];
    vec_sub(a, b, d);
    return vec_norm(d);
}
/* Scales a to length 1 and returns its old length; a zero vector stays zero. */
static inline double vec_normalize(double a[3])
{
    double n = vec_norm(a);
    if (n > 0) vec_scale(a, 1 / n, a);
    return n;
}
/* out = M a, M row-major; out may not alias a */
static inline void mat_apply(const double m[9], const double a[3], double out[3])
{
    for (int r = 0; r < 3; r++) out[r] = m[3 * r] * a[0] + m[3 * r + 1] * a[1] + m[3 * r + 2] * a[2];
}
/* out = M^T a; out may not alias a */
static inline void mat_apply_transposed(const double m[9], const double a[3], double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = m[c] * a[0] + m[3 + c] * a[1] + m[6 + c] * a[2];
}
static inline double mat_det(const double m[9])
{
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}
/* Six times the signed volume of tet (a,b,c,d); positive by the right-hand rule. */
static inline double vec_six_volume(const double a[3], const double b[3], const double c[3], const double d[3])
{
    double u[3], v[3], w[3], n[3];
    vec_sub(b, a, u);
    vec_sub(c, a, v);
    vec_sub(d, a, w);
    vec_cross(u, v, n);
    return vec_dot(n, w);
}

#ifdef __cplusplus
}
#endif
