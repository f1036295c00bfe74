/* boundary: which coordinates of which node are unknown, once the bones say where they are.
 *
 * Node v lies at x_v = origin_v + sum_k basis_vk z[unknown_vk]; unknown -1 means z = 0 (prescribed).
 *   free     three unknowns along x, y, z; origin = rest position
 *   tied     none; origin = T X with T the motion of its segment
 *   sliding  two, across the normal turned by T; origin = T X, so the node stays on the moved tangent plane (or at its
 *            shift from it)
 *   pair     five for two nodes: one shared, along the pair normal, and two each across it. The lips keep in touch and
 *            slide along each other without friction; they cannot part: opening lips needs contact instead. The
 *            directions turn with the guide.
 *
 * The guide is the rigid motion that fits the prescribed nodes best, and exactly theirs where they all share one. It
 * carries what the bones do not: origin of pairs and the first guess for free nodes. */
#pragma once
#include "geometry/attach_map.h"
#include "geometry/rigid.h"
#include "geometry/segments.h"
#include "geometry/tetmesh.h"
#include "sim/targets.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct boundary {
    int32_t node_count, unknown_count;
    int32_t *unknown; /* [3*node_count], numbered along the nodes */
    uint8_t *plain;   /* [node_count] 1: basis is x, y, z and all three are unknown */
    double *origin;   /* [3*node_count] mm */
    double *basis;    /* [9*node_count] three unit vectors each */
    rigid guide;
} boundary;

/* Unknowns of a map with all bones at rest. Refuses (ERR_INPUT) an attachment map that contradicts itself or
 * the mesh; (ERR_GEOMETRY) nodes in no tet and any part of the mesh that its tied and sliding nodes do not
 * hold in place: each is named by its size and position. */
bool boundary_make(const tetmesh *m, const attach_map *a, boundary *out, err *e) MUST_CHECK;
/* The same where targets (may be NULL) hold the mesh too. */
bool boundary_make_drawn(const tetmesh *m, const attach_map *a, const targets *t, boundary *out, err *e) MUST_CHECK;
void boundary_free(boundary *b);

/* Moves the bones: new origin, basis and guide; the numbering of unknowns stays. */
void boundary_move(boundary *b, const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT]);
/* x[3*node_count] from z[unknown_count]. */
void boundary_place(const boundary *b, const double *z, double *x);
/* z from x: the nearest admissible positions (a shared unknown takes the mean). */
void boundary_project(const boundary *b, const double *x, double *z);
/* Force per unknown from force[3*node_count]. */
void boundary_reduce(const boundary *b, const double *force, double *g);

#ifdef __cplusplus
}
#endif
