/* motion: rigid moves in parts, and the one rigid move that fits several best. */
#pragma once
#include "geometry/rigid.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

/* The part s in [0, 1] of a move along its own screw (rotation by s times the angle about one fixed axis,
 * advancing in proportion); s = 0 is the identity and s = 1 the move itself, both exactly. */
rigid motion_part(const rigid *whole, double s);

/* Least squares over points: the rigid move closest to from[k] -> to[k]. count 0 gives the identity; fewer
 * than three points, or points on one line, give a translation only. */
rigid motion_fit(const double *from, const double *to, int64_t count);

#ifdef __cplusplus
}
#endif
