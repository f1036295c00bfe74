/* head_sound: whether a shape that nobody was measured for is a head: a model knows directions, not what may not be. */
#pragma once
#include "app/planner/identity/head.h"

typedef struct head_soundness {
    double min_j; /* least volume of a tetrahedron over its volume in the template, at rest and at neutral */
    int32_t inverted_tets;
    /* NaN where tetrahedra are inverted: not asked then, because it takes long */
    double bone_out_mm;      /* how far the farthest vertex of bone or tooth lies outside the skin; 0: none does */
    case_surface bone;       /* whose vertex that is */
    double teeth_overlap_mm; /* the deepest vertex of a lower tooth in the upper ones, or the other way about */
} head_soundness;

/* Refuses what nearest_create refuses of its surfaces. */
bool head_soundness_of(const head_template *t, const head_shape *s, head_soundness *out, err *e) MUST_CHECK;
/* Refuses (ERR_GEOMETRY), with the numbers, an inverted tetrahedron, bone or tooth outside the skin, and upper and
 * lower teeth that lie deeper in each other than `template_overlap_mm` and 0.1 mm more. */
bool head_sound(const head_soundness *f, double template_overlap_mm, err *e) MUST_CHECK;
/* The deepest vertex of a lower tooth in the upper ones, or the other way about; 0: none is. Refuses what
 * nearest_create refuses. */
bool head_teeth_overlap(const surface *upper, const surface *lower, double *deepest_mm, err *e) MUST_CHECK;
