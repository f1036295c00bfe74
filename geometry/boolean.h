/* boolean: volume operations on closed surfaces (CGAL corefinement, geometry/cgal). */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum boolean_op { BOOLEAN_UNION, BOOLEAN_INTERSECTION, BOOLEAN_DIFFERENCE } boolean_op;

typedef struct boolean_report {
    int attempts; /* 1: as given; up to 6: b was shifted by shift_mm, because a and b share points or planes
                   */
    double shift_mm;
    bool exact;          /* rounded intersection points failed, exact ones were used */
    bool repaired;       /* rounding left folds at the cut, cut out and refilled (repair_solid) */
    double volume_error; /* |V(a and b) + V(a without b) - V(a)| / max(V(a), V(b)) of the attempt that was
                            taken */
} boolean_report;

/* a op b. Both must be closed, outward and free of self-intersection (ERR_GEOMETRY names which is not). *out
 * is the same, and its volume is consistent with those of a and b to 1e-6; it may be empty (vertex_count 0).
 * Surfaces that are not cut keep their vertices to the bit (b up to the shift). The caller frees. report may
 * be NULL. Vertices are numbered as the triangles of *out name them: the same input gives the same bits. */
bool boolean_apply(const surface *a, const surface *b, boolean_op op, surface *out, boolean_report *report,
                   err *e) MUST_CHECK;

/* The union of count closed surfaces, two by two; names the first that is not sound. */
bool boolean_unite(const surface *part, int count, surface *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
