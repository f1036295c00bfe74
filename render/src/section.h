/* Private: the curve in which a plane cuts a surface. */
#pragma once
#include "geometry/surface.h"

/* Pieces of the curve, one per triangle that the plane passes: [6*count] mm, in place after `move`; and the numbers of
 * the triangles. Both newly allocated. */
double *section_of(const surface *s, const rigid *move, const double point[3], const double normal[3],
                   int32_t **triangle, int *count);
