/* open_border: triangles at the open border of a surface. */
#pragma once
#include "geometry/surface.h"

/* 1 for each triangle with a vertex on an edge that only one triangle has [triangle_count]; the caller frees. */
uint8_t *open_border_triangles(const surface *s);
