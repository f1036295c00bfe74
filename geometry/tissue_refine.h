/* tissue_refine: the same tissue in tets of half the size, for studies of convergence: shape, attachment and
 * lips stay what they are, so that only the discretisation differs. */
#pragma once
#include "geometry/tissue.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Each tet becomes eight (Bey 1995: four at the corners, four around the shortest diagonal of the octahedron
 * between them): tets 8t to 8t + 7 of *out. A new node on an edge of the surface takes what its two ends
 * share: tied between tied ends of one segment, sliding where one or both slide on it, paired where both ends
 * are on the lips' contact (or its rim); else it is free. The caller frees *out. */
void tissue_refine(const tissue *t, tissue *out);
/* The same points carried by the refined tissue; allocates *out. */
void embedding_refine(const embedding *e, const tetmesh *coarse, const tetmesh *fine, embedding *out);

#ifdef __cplusplus
}
#endif
