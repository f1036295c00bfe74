/* restraint: is every part of the mesh held by bone? */
#pragma once
#include "geometry/attach_map.h"
#include "geometry/tetmesh.h"

/* Refuses (ERR_GEOMETRY) nodes in no tet, and mesh parts that could move rigidly with tied nodes still and
 * sliding nodes on their planes. Pairs do not count: they would let a part slide away. */
bool restraint_check(const tetmesh *m, const attach_map *a, err *e) MUST_CHECK;
