/* similarity: a turn, a shift and a size that lay points on others. x' = motion(scale x). */
#pragma once
#include "geometry/rigid.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct similarity {
    double scale; /* > 0 */
    rigid motion; /* after the scale */
} similarity;

similarity similarity_identity(void);
void similarity_apply(const similarity *s, const double x[3], double out[3]); /* out may alias x */
similarity similarity_inverse(const similarity *s);

/* Least squares over from[3*count] -> to[3*count]: the turn by its quaternion, the size by the spreads of both sides
 * (Horn, "Closed-form solution of absolute orientation using unit quaternions", J. Opt. Soc. Am. A 4, 1987), so that
 * neither side is favoured. with_scale false: scale stays 1. weight [count] >= 0, or NULL: all alike. Needs three
 * points that are not in a line; returns the root of the weighted mean square that is left, in units of `to`. */
double similarity_of_pairs(const double *from, const double *to, const double *weight, int32_t count, bool with_scale,
                           similarity *out);

typedef struct plane_pair { /* a point that is to lie in the plane of another */
    double at[3], to[3], normal[3];
    double weight;
} plane_pair;
/* Betters *s by one small step, in the frame that it leads into: p->at there, after *s (Chen and Medioni, "Object
 * modelling by registration of multiple range images", Image and Vision Computing 10, 1992). Returns how far the step
 * moves the points on average, mm; 0 where the pairs leave the motion open, and *s stays. */
double similarity_plane_step(const plane_pair *p, int32_t count, bool with_scale, similarity *s);

#ifdef __cplusplus
}
#endif
