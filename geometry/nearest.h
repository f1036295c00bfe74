/* nearest: closest points, rays and inside tests on a triangle surface (CGAL AABB tree, geometry/cgal). */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct nearest nearest; /* queries are const and thread-safe */

/* Builds the tree over a copy of s. Refuses (ERR_GEOMETRY) an empty or non-finite surface. */
bool nearest_create(const surface *s, nearest **out, err *e) MUST_CHECK;
void nearest_destroy(nearest **n);
/* Distance in mm from p to the surface; point and triangle may be NULL. */
double nearest_point(const nearest *n, const double p[3], double point[3], int32_t *triangle);
/* The same from the answer at a place nearby, point and triangle, which make way for the answer here: quicker. */
double nearest_point_onward(const nearest *n, const double p[3], double point[3], int32_t *triangle);
/* First hit of the ray from `from` along `direction` (need not be unit); false if none. */
bool nearest_ray(const nearest *n, const double from[3], const double direction[3], double hit[3], int32_t *triangle);
/* True if p lies inside the closed surface (parity of crossings; shells that overlap must be united first). */
bool nearest_inside(const nearest *n, const double p[3]);

#ifdef __cplusplus
}
#endif
