/* embed: points carried by tetrahedra through barycentric coordinates. */
#pragma once
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct embedding {
    int32_t point_count;
    int32_t *tet;   /* [point_count] or -1: not carried, stays in place */
    double *weight; /* [4*point_count] barycentric, sum 1; negative where the point lies outside its tet */
    double max_gap_mm, mean_gap_mm; /* distance of the carried points from their tets */
} embedding;

/* Finds for each point the tet that contains it, else the nearest one within reach_mm; points farther away are not
 * carried. allowed (may be NULL) restricts: allowed(point, tet, context) != 0. Weights are those of the closest
 * point of the tet plus the offset, so that affine fields are reproduced exactly. The caller frees *out. */
typedef bool embed_allowed(int32_t point, int32_t tet, void *context);
embedding embed_points(const tetmesh *m, const double *xyz, int32_t count, double reach_mm, embed_allowed *allowed,
                       void *context);
void embedding_free(embedding *e);
/* out[3*point_count] = xyz + sum of weighted node displacements u[3*vertex_count]; out may alias xyz. */
void embedding_apply(const embedding *e, const tetmesh *m, const double *u, const double *xyz, double *out);

#ifdef __cplusplus
}
#endif
