/* boolean: exact volume operations on closed surfaces (CGAL corefinement, geometry/cgal). */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum boolean_op { BOOLEAN_UNION, BOOLEAN_INTERSECTION, BOOLEAN_DIFFERENCE } boolean_op;

/* a op b. Both must be closed, outward and free of self-intersection (ERR_GEOMETRY names which is not). *out is
 * closed; it may be empty (vertex_count 0). The caller frees it. */
bool boolean_apply(const surface *a, const surface *b, boolean_op op, surface *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
