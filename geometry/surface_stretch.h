/* surface_stretch: how a surface was stretched within itself. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Per vertex of two surfaces of the same triangles: the largest principal stretch of the triangles around it,
 * as a mean weighted by their area at rest, in percent over 1: 0 where nothing stretches, negative where it
 * shrinks in all directions. The stretch of a triangle is the largest singular value of the map of its plane.
 * NaN at vertices whose triangles have no area. out[vertex_count]. */
void surface_stretch(const surface *rest, const surface *moved, double *out);

#ifdef __cplusplus
}
#endif
