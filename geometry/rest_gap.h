/* rest_gap: how far the nodes of the tissue's surface lie from bones and saw cuts at rest. Every plan of a case asks
 * it: where a bone comes no farther than the gap, nothing changed. */
#pragma once
#include "geometry/segment_trees.h"
#include "geometry/tissue.h"
#ifdef __cplusplus
extern "C" {
#endif

extern const double rest_gap_exact_mm; /* gaps to here are exact, those beyond at most too small */

typedef struct rest_gap {
    double *part[SEGMENT_COUNT]; /* [nodes] mm, negative inside the bone; NULL: the case has no such segment */
    double *kerf;                /* [nodes] the same of the saw cuts; NULL: nothing is cut */
} rest_gap;                      /* NaN at nodes that are not asked */

/* Nodes on skin, bone and holes; those inside the tissue and on its cut faces meet no bone. */
static inline bool rest_gap_asks(const tissue *t, int32_t v)
{
    return t->side[v] == SIDE_BONE || t->side[v] == SIDE_HOLE || t->side[v] == SIDE_SKIN;
}

/* bones: at rest. The caller frees *out. */
void rest_gap_make(const tissue *t, const segment_trees *bones, rest_gap *out);
void rest_gap_free(rest_gap *g); /* idempotent */

#ifdef __cplusplus
}
#endif
