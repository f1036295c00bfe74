/* assemble_parts: what the files of the assembly share. */
#pragma once
#include "geometry/vec.h"
#include "sim/assemble.h"
#include "sim/src/elastic/average.h"
#include <stddef.h>

enum { ELEMENT_GRAIN = 256, NODE_GRAIN = 512, EDGE_GRAIN = 1024 };

/* Positions of the nodes of tet t. */
static inline void element_nodes(const int32_t *tet, int64_t t, const double *x, double x_e[12])
{
    for (int k = 0; k < 4; k++) vec_copy(x + 3 * (size_t)tet[4 * t + k], x_e + 3 * k);
}
