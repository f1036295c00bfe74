/* smoothed_motion: the trivial prediction that a mechanical one has to beat: skin that follows the bone below it. */
#pragma once
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

/* after[3*skin->vertex_count]: the skin plus 0.85 times the mean displacement of the 40 nearest bone vertices of the
 * segments at rest, weighted by a Gaussian of 12 mm; vertices with selected[v] == 0 stay. Equal distances are taken in
 * the order of segments and vertices. Refuses (ERR_GEOMETRY) segments with fewer than 40 vertices. */
bool smoothed_motion(const surface *skin, const uint8_t *selected, const segments *at_rest,
                     const rigid move[SEGMENT_COUNT], double *after, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
