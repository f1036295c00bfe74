/* scene_part: the part of the tissue that a plan moves, as a problem of its own with its own numbers. */
#pragma once
#include "sim/equilibrium.h"

typedef struct scene_part {
    tetmesh mesh;
    attach_map attach;
    int32_t *node, *local, *tet; /* [part nodes] in the whole; [whole nodes] here or -1; [part tets] in the whole */
    uint8_t *held;               /* [whole nodes] could move, but is left out */
    int32_t held_count;
    contact_setup contact; /* of the lists below, where the whole has contact */
    int32_t *upper, *lower, *extra;
} scene_part;

/* Nodes that are estimated to move less than limit_mm (estimate[whole nodes]) are held where the cranium is; tets
 * without an unknown go. The caller frees. */
void scene_part_make(const equilibrium_problem *problem, const double *estimate, double limit_mm, scene_part *out);
void scene_part_free(scene_part *p);
/* Solves the part, from start[3*whole nodes] if not NULL. *out is of the whole mesh: what is left out goes with the
 * cranium. Refuses what equilibrium_solve refuses. */
bool scene_part_solve(const equilibrium_problem *problem, const scene_part *p, const double *start,
                      const solve_params *params, equilibrium *out, err *e) MUST_CHECK;
