/* cut_rims: the lines along which segments were sawn from each other, for drawing. */
#pragma once
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct cut_rims {
    double *piece[SEGMENT_COUNT]; /* [6*count] both ends of each piece, mm, on the segment at rest */
    int count[SEGMENT_COUNT];
} cut_rims;

/* Edges of a segment sharper than 40 degrees, both ends of which have a vertex within reach_mm (a little more
 * than the saw is wide) of a segment that was cut from the same bone. The caller frees. */
cut_rims cut_rims_find(const segments *at_rest, double reach_mm);
void cut_rims_free(cut_rims *r); /* idempotent */

#ifdef __cplusplus
}
#endif
