/* tet_volume: volumes of tets whose nodes have moved. */
#pragma once
#include "geometry/tetmesh.h"
#include "geometry/vec.h"

/* Six times the volume of a tet with nodes in xyz; below 0: inside out. */
static inline double tet_six_volume(const double *xyz, const int32_t tet[4])
{
    return vec_six_volume(xyz + 3 * (size_t)tet[0], xyz + 3 * (size_t)tet[1], xyz + 3 * (size_t)tet[2],
                          xyz + 3 * (size_t)tet[3]);
}

/* J of a tet: its volume with the nodes at x[3*nodes] over that in the mesh. */
static inline double tet_j(const tetmesh *m, const double *x, int32_t tet)
{
    const int32_t *node = m->tet + 4 * (size_t)tet;
    return tet_six_volume(x, node) / tet_six_volume(m->xyz, node);
}

/* The smallest J of all tets; *inverted (may be NULL): how many are not above 0. */
double tets_min_j(const tetmesh *m, const double *x, int32_t *inverted);
