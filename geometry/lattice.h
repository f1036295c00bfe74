/* lattice: tetrahedra of one shape and size around surfaces, for bodies whose inside does not matter.
 *
 * Body-centred cubic: nodes at the corners and in the middles of cubes of edge a. Each face between two cubes gives
 * four tets, of the two middles and one side of the face: 12 per cube, of volume a^3/12, edges a (two) and sqrt(3)/2 a
 * (four), dihedral angles of 60 and 90 degrees, circumscribed sphere of radius sqrt(5)/4 a about the centroid. */
#pragma once
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Every tet that meets a triangle of the surfaces or comes within margin_mm of one, and those around it that the
 * circumscribed sphere takes for one. The nodes lie at whole and half multiples of edge_mm. All regions are 0. The
 * caller frees *out. Refuses (ERR_INPUT) an edge that is not above 0 or a margin below 0, (ERR_GEOMETRY) surfaces
 * without a triangle, (ERR_RESOURCE) more than 100 million cubes in their box. */
bool lattice_cover(const surface *const *list, int32_t count, double edge_mm, double margin_mm, tetmesh *out,
                   err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
