/* join_corners: a surface whose triangles arrive apart, each with corners of its own that were rounded one by one. */
#pragma once
#include "geometry/surface.h"

enum { JOIN_REFUSED_FROM = 8 /* triangles; fewer are no body but somebody's trial */ };

typedef struct corner_join {
    int32_t joined_vertices; /* made one with another that is near, but not at the same place */
    double distance_mm;      /* within which they were joined */
} corner_join;

/* Where more than a tenth of the sides of triangles lie open, joins corners within 0, 0.001 and 0.01 mm, at most a
 * twentieth of the mean side, and stops once few are open; other surfaces stay as they are. Refuses (ERR_GEOMETRY, with
 * path) what is still mostly loose triangles. */
bool join_corners(surface *s, const char *path, corner_join *done, err *e) MUST_CHECK;
