/* check_fit: how points would have to be moved, turned or scaled to lie on surfaces. */
#pragma once
#include "geometry/nearest.h"

enum { FIT_BODIES_MOST = 2 };
/* One body of one or two surfaces: a bone, and its teeth where they are a file of their own. */
typedef struct fit_body {
    int count;
    const surface *mesh[FIT_BODIES_MOST];
    const nearest *tree[FIT_BODIES_MOST];
} fit_body;

typedef enum fit_freedom { FIT_NOTHING = 0, FIT_SHIFT = 3, FIT_SCALE = 4, FIT_TURN = 6 } fit_freedom;

/* A point p of the body lies at m p + t of the surfaces. */
typedef struct fit_way {
    double m[9], t[3];
} fit_way;

/* Distance of p from the body, mm; point and normal (of its triangle) may be NULL. */
double fit_distance(const fit_body *b, const double p[3], double point[3], double normal[3]);
/* Betters *way by what is free (shift; shift and scale; shift and turn), from where it is. Returns the mean distance of
 * the nearer four fifths of the points, mm: a few that are misplaced do not count. p: [3*count]. */
double fit_points(const fit_body *b, const double *p, int count, fit_freedom freedom, fit_way *way);
