/* warp: a smooth map of space that takes given points exactly to given points (multiquadrics with an affine
 * part). */
#pragma once
#include "geometry/surface.h"

typedef struct warp {
    int count;
    double *from;   /* [3*count] mm */
    double *weight; /* [3*(count+4)] of the basis functions, then of 1, x, y, z */
} warp;

typedef struct warp_pairs { /* filled point by point */
    int count, room;
    double *from, *to; /* [3*count] */
} warp_pairs;

void warp_add(warp_pairs *p, const double from[3], const double to[3]);
void warp_pairs_free(warp_pairs *p);
/* At least four points that are not in one plane, no two alike. */
warp warp_through(const warp_pairs *p);
void warp_free(warp *w);
void warp_apply(const warp *w, const double x[3], double out[3]); /* out may alias x */
void warp_surface(const warp *w, surface *s);
