/* restraint: is every part of the mesh held by bone or by targets? */
#pragma once
#include "geometry/attach_map.h"
#include "geometry/tetmesh.h"
#include "sim/targets.h"

/* Refuses (ERR_GEOMETRY) nodes in no tet, and mesh parts that could move rigidly with tied nodes still and
 * sliding nodes on their planes against no target (targets may be NULL). Pairs do not count: they would let a part
 * slide away. */
bool restraint_check(const tetmesh *m, const attach_map *a, const targets *t, err *e) MUST_CHECK;
