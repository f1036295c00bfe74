/* bone_cells: the bone of a body as small lumps, to add up how much of it lies within another. */
#pragma once
#include "geometry/solid_grid.h"

typedef struct bone_block { /* members first .. first + count, within radius of centre */
    double centre[3], radius, mm3;
    int32_t first, count;
} bone_block;

typedef struct bone_cells {
    int32_t count, part_count, block_count;
    double *lump;      /* [4*count] middle of the bone in the cell, its volume */
    bone_block *part;  /* of up to 2 x 2 x 2 lumps */
    bone_block *block; /* of up to 2 x 2 x 2 parts */
} bone_cells;

/* Cells of a lattice that lies aslant to all axes, so that no plane of the bone runs along it; those at the surface
 * hold their own share. The sum is the body's volume to rounding. */
bone_cells bone_cells_make(const surface *s, const solid_grid *grid, double cell_mm);
void bone_cells_free(bone_cells *b);
/* mm^3 of the lumps that `move` takes into the other body. */
double bone_cells_inside(const bone_cells *b, const solid_grid *other, const rigid *move);
