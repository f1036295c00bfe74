/* segment_trees: trees over the surfaces of a case at rest, for all that asks them; see nearest.h. */
#pragma once
#include "geometry/nearest.h"
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct segment_trees {
    nearest *part[SEGMENT_COUNT]; /* NULL where there is no such segment */
    nearest *kerf;                /* NULL where nothing is cut */
    nearest *skin;                /* NULL where none was given */
} segment_trees;

/* skin may be NULL. Refuses what nearest_create refuses. The caller frees *out, which copies the surfaces. */
bool segment_trees_make(const segments *s, const surface *skin, segment_trees *out, err *e) MUST_CHECK;
void segment_trees_free(segment_trees *t); /* idempotent */

#ifdef __cplusplus
}
#endif
