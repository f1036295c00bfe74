/* surface: a triangle mesh as flat arrays. Counter-clockwise from outside; coordinates LPS mm. */
#pragma once
#include "geometry/err.h"
#include "geometry/rigid.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct surface {
    int32_t vertex_count, triangle_count;
    double *xyz;  /* [3*vertex_count] mm */
    int32_t *tri; /* [3*triangle_count] vertex numbers */
    uint8_t *rgb; /* [3*vertex_count] colours of the vertices, or NULL */
} surface;

surface surface_new(int32_t vertex_count, int32_t triangle_count); /* zeroed arrays */
void surface_free(surface *s);                                     /* idempotent, leaves zero */
surface surface_copy(const surface *s);
/* Indices in range, coordinates finite, no triangle with a repeated vertex; names the first offender. */
bool surface_check(const surface *s, err *e) MUST_CHECK;
void surface_bounds(const surface *s, double low[3], double high[3]);
double surface_area(const surface *s);   /* mm^2 */
double surface_volume(const surface *s); /* mm^3; meaningful for closed surfaces, positive if outward */
/* Area-weighted unit vertex normals [3*vertex_count]; caller frees. Unused vertices get zero. */
double *surface_vertex_normals(const surface *s);
void surface_transform(surface *s, const rigid *a);
void surface_flip(surface *s); /* reverses the orientation */
/* Edges used by one triangle, and edges used by more than two. */
void surface_edge_census(const surface *s, int32_t *boundary_edges, int32_t *nonmanifold_edges);
int32_t surface_hole_count(const surface *s); /* groups of boundary edges that share vertices */
/* Component number per triangle [triangle_count] (shared vertices connect), numbered by first triangle; returns
 * the count; caller frees. */
int32_t surface_components(const surface *s, int32_t **component);
/* Keeps triangles with keep[t] != 0 and drops unused vertices. */
surface surface_select(const surface *s, const uint8_t *keep);
/* Puts b after a (no welding, no colours). */
surface surface_joined(const surface *a, const surface *b);

#ifdef __cplusplus
}
#endif
