/* clash_body: what a body is made of, for the files of clash. */
#pragma once
#include "geometry/clash.h"
#include "geometry/src/distance/bone_cells.h"
#include "geometry/src/distance/patches.h"

struct clash_body {
    const surface *s;
    uint8_t *kind; /* NULL: all 1 */
    double tolerance_mm;
    solid_grid *grid;
    distance_tree *tree;
    patches patches;
    bone_cells cells;
};
