/* radial: a closed body that is star-shaped about a centre, through given points (cubic radial basis
 * functions on the sphere of directions). */
#pragma once

typedef struct radial {
    double centre[3];
    int count;
    double *direction; /* [3*count] unit */
    double *weight;    /* [count+4] of the basis functions, then of 1, x, y, z */
} radial;

/* Through every point[3*i] and its mirror image at -x (points with x == 0 have none). */
radial radial_through(const double centre[3], const double (*point)[3], int count);
void radial_free(radial *r);
/* Signed distance to first order, negative inside, mm. */
double radial_distance(const radial *r, const double p[3]);
