/* rigid: rigid transforms x' = R x + t; R row-major 3x3 (det +1), t in mm, axes LPS, angles in radians. */
#pragma once
#include "geometry/err.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct rigid {
    double r[9];
    double t[3];
} rigid;

rigid rigid_identity(void);
bool rigid_is_identity(const rigid *a);                              /* exactly */
void rigid_apply(const rigid *a, const double x[3], double out[3]);  /* out may alias x */
void rigid_rotate(const rigid *a, const double v[3], double out[3]); /* directions; out may alias v */
rigid rigid_compose(const rigid *outer, const rigid *inner);         /* x -> outer(inner(x)) */
rigid rigid_inverse(const rigid *a);
rigid rigid_translation(const double t_mm[3]);
/* Rotation by angle_rad about the unit axis through pivot. */
rigid rigid_rotation(const double pivot[3], const double axis[3], double angle_rad);
/* 16 numbers row-major, last row 0 0 0 1. Refuses (ERR_INPUT) a matrix whose rotation part is not orthonormal
 * to 1e-6 or mirrors; the accepted rotation is re-orthonormalised. */
bool rigid_from_matrix(const double m[16], rigid *out, err *e) MUST_CHECK;
void rigid_to_matrix(const rigid *a, double m[16]);
/* Angle of the rotation, in [0, pi]. */
double rigid_angle(const rigid *a);

#ifdef __cplusplus
}
#endif
