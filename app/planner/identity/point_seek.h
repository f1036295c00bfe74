/* point_seek: the point of a surface near by that lies farthest in a direction. All in one frame, mm. */
#pragma once
#include "geometry/surface.h"

typedef struct point_seek {
    double from[3], direction[3]; /* unit, or zero: the nearest point */
    double pull[3];               /* 1/mm: a place d mm from `from` must gain pull d^2 / 2 mm, axis by axis */
    double reach_mm;              /* no farther than this from `from` */
    int facing;                   /* 1: where the surface faces the direction, -1: looks away from it, 0: anywhere */
} point_seek;

/* Triangles with a corner within reach_mm of x; the caller frees. */
surface point_crop(const surface *s, const double x[3], double reach_mm);
/* On the piece of rightly facing surface that comes nearest. False: there is none within reach. */
bool point_seek_on(const surface *near_by, const point_seek *s, double out[3]);
/* Of the farthest points across a saddle the one that is least far: `from` 1 mm apart, 6 mm to both sides along the
 * axis. */
bool point_seek_saddle(const surface *near_by, const point_seek *s, int axis, double out[3]);
