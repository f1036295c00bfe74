/* distance_tree: how far a surface is, as far as it matters to the asker.
 *
 * Boxes around triangles, halved down to a few of them. What makes it fast is that most askers need the
 * distance only between two bounds: below the lower one the search ends at once, beyond the upper one it
 * never begins. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct distance_tree distance_tree; /* queries are const and thread-safe */

/* Copies what it needs of s, which may be empty. */
distance_tree *distance_tree_make(const surface *s);
void distance_tree_free(distance_tree **t); /* idempotent */

typedef struct distance_hit {
    double at[3]; /* the nearest point, only if distance < high */
    int32_t triangle;
} distance_hit;

/* Distance from p in mm if it lies between low and high; `high` if it is larger (or there is no triangle);
 * something not above low if it is smaller. hit (may be NULL) is for exact distances, and untouched where
 * there is none. */
double distance_tree_between(const distance_tree *t, const double p[3], double low, double high, distance_hit *hit);
/* The distance itself. */
double distance_tree_to(const distance_tree *t, const double p[3], distance_hit *hit);
/* The surface is nearer than reach_mm. */
bool distance_tree_within(const distance_tree *t, const double p[3], double reach_mm);

#ifdef __cplusplus
}
#endif
