/* patches: the triangles of a surface by where they lie, in two steps, to leave out many of them at a glance. */
#pragma once
#include "geometry/surface.h"

typedef struct patch { /* members first .. first + count, within radius of centre */
    double centre[3], radius;
    int32_t first, count;
    unsigned kinds; /* any of its triangles' */
} patch;

typedef struct patches {
    int32_t count, group_count;
    patch *patch; /* of triangles: order[first ..) */
    patch *group; /* of patches */
    int32_t *order;
} patches;

/* kind[triangle_count] may be NULL: all 1. box[6] (low, high) may be NULL: patches that lie outside it are left out. */
patches patches_make(const surface *s, const uint8_t *kind, const double *box);
void patches_free(patches *p);
