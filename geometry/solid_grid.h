/* solid_grid: inside or outside of a closed surface, exact and fast, for very many points.
 *
 * Space is cut into cubes that know the triangles within them and whether one point of theirs is inside; any other
 * point of the cube is compared with that one. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct solid_grid solid_grid; /* queries are const and thread-safe */

/* Copies what it needs of s. box[6] (low, high) may be NULL: what lies outside it is left out, as if the body ended
 * there. Refuses (ERR_GEOMETRY) a surface that is empty or not closed. */
bool solid_grid_make(const surface *s, double step_mm, const double *box, solid_grid **out, err *e) MUST_CHECK;
void solid_grid_free(solid_grid **g); /* idempotent */
/* By parity: shells that overlap must be united first. */
bool solid_grid_inside(const solid_grid *g, const double p[3]);
/* The surface is at least this far from p, mm; 0 near it. Cheap. */
double solid_grid_clear(const solid_grid *g, const double p[3]);
/* Both at once. */
bool solid_grid_look(const solid_grid *g, const double p[3], double *clear);

#ifdef __cplusplus
}
#endif
