/* tetmesh: linear tetrahedra as flat arrays. Tets are positive by the right-hand rule; coordinates LPS mm. */
#pragma once
#include "geometry/err.h"
#include "geometry/surface.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct tetmesh {
    int32_t vertex_count, tet_count;
    double *xyz;     /* [3*vertex_count] mm */
    int32_t *tet;    /* [4*tet_count] vertex numbers */
    int32_t *region; /* [tet_count] label, meaning given by the maker */
} tetmesh;

typedef struct tetmesh_quality {
    double min_dihedral_deg, max_dihedral_deg;
    double min_radius_ratio, mean_radius_ratio; /* 3 r_in / r_circum: 1 regular, 0 flat */
    double min_volume_mm3, volume_mm3;
    double min_edge_mm, mean_edge_mm, max_edge_mm;
} tetmesh_quality;

tetmesh tetmesh_new(int32_t vertex_count, int32_t tet_count);
void tetmesh_free(tetmesh *m);
tetmesh tetmesh_copy(const tetmesh *m);
/* Indices in range, coordinates finite, every tet of positive volume; names the first offender. */
bool tetmesh_check(const tetmesh *m, err *e) MUST_CHECK;
tetmesh_quality tetmesh_measure(const tetmesh *m);

/* Faces used by one tet, outward, ordered by tet then local face. face[3*count] vertex numbers, tet_of[count];
 * the caller frees both; tet_of may be NULL. Returns the count. */
int32_t tetmesh_boundary(const tetmesh *m, int32_t **face, int32_t **tet_of);
/* For tet t and local face k (opposite vertex k): the tet across, or -1. [4*tet_count]; caller frees. */
int32_t *tetmesh_neighbours(const tetmesh *m);
/* Vertex numbers of local face k, outward: tet_face[k][3] index into the four vertices of a tet. */
extern const int tet_face[4][3];

#ifdef __cplusplus
}
#endif
