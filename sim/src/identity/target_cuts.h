/* target_cuts: where a scan was cut, at the end of what was in the picture. */
#pragma once
#include "geometry/surface.h"

typedef struct half_edge {
    int32_t low, high, triangle, corner; /* low < high: its ends; corner: of the triangle, opposite */
} half_edge;

/* The three of each triangle, those with the same ends side by side; the caller frees. */
half_edge *half_edges_sorted(const surface *s);
bool half_edge_same(const half_edge *a, const half_edge *b);

/* [triangles] 1: of a plane piece of 400 mm^2 and more, or of the rounded edge about it, 1.5 mm; edge as sorted above.
 * No part of a head is so large and plane within 0.1 mm. The caller frees. */
uint8_t *target_cuts(const surface *s, const half_edge *edge);
