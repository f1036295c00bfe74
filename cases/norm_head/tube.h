/* tube: a body swept along a smooth curve, round or flattened, its radius varying along the curve. */
#pragma once

enum { TUBE_STEPS = 6 }; /* pieces between two control points: 0.1 mm from the curve for the curves used here */

typedef struct tube {
    int count;
    double (*ball)[4];       /* [count] x, y, z, radius along the curve */
    double centre[3], reach; /* ball that contains the tube */
    double (*stretch)[4];    /* [(count-1)/TUBE_STEPS] centre and radius of the ball around each TUBE_STEPS pieces */
    double across[3], flat;  /* the section is `flat` times wider along the unit vector across */
} tube;

/* Catmull-Rom through control points of x, y, z, radius. Round. */
tube tube_round(const double (*control)[4], int count);
tube tube_flat(const double (*control)[4], int count, const double across[3], double flat);
void tube_free(tube *t);
/* Signed distance, negative inside. */
double tube_distance(const tube *t, const double p[3]);
/* sdf_union and sdf_cut of the body at distance d with the tube; cheap where they are too far apart to blend.
 */
double tube_union(double d, const tube *t, const double p[3], double k);
double tube_cut(double d, const tube *t, const double p[3], double k);
