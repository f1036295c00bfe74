/* frame: the head's own axes, from the Frankfort horizontal plane (porion left and right, orbitale). */
#pragma once
#include "geometry/landmarks.h"
#include "geometry/rigid.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct head_frame {
    double origin[3]; /* midpoint of the porions, mm */
    double left[3];   /* unit axes, right-handed: left x posterior = up */
    double posterior[3];
    double up[3];
    double residual_mm; /* largest distance of Po_L, Po_R, Or_L, Or_R from the plane */
} head_frame;

/* Needs Po_L, Po_R and Or_L or Or_R (least squares with both). Refuses (ERR_INPUT) missing or collinear points and
 * a frame that is more than 60 degrees off the file axes (+x left, +y posterior, +z up): a mirrored or turned
 * head. */
bool head_frame_from_landmarks(const landmarks *l, head_frame *out, err *e) MUST_CHECK;
/* Coordinates (left, posterior, up) of a point relative to the origin, and back. */
void head_frame_to_local(const head_frame *f, const double p[3], double local[3]);
void head_frame_to_world(const head_frame *f, const double local[3], double p[3]);

#ifdef __cplusplus
}
#endif
