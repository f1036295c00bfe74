/* aggregate: the coarse space of a level, by smoothed aggregation (Vanek, Mandel, Brezina 1996). Nodes that
 * hang together strongly form aggregates; each moves as its rigid motions do, smoothed by one damped Jacobi
 * step. */
#pragma once
#include "sim/src/linear/blocks.h"

enum { MODES = 6 }; /* rigid motions */

/* blocks_per_node: of every node, consecutive. of[nodes]: its aggregate, -1: none (nothing strong around it,
 * which smoothing alone solves). Returns how many there are. */
int32_t aggregate_nodes(const blocks *a, int blocks_per_node, int32_t *of);
/* The prolongation from two blocks per aggregate, its columns orthonormal before smoothing. modes[18*rows]:
 * values of the rigid motions, [component][mode] in each block; coarse_modes[18*2*count]: the same there.
 * inverse[9*rows]: inverse diagonal blocks; damping: of the Jacobi step. */
blocks aggregate_prolongation(const blocks *a, int blocks_per_node, const int32_t *of, int32_t count,
                              const double *modes, const double *inverse, double damping, double *coarse_modes);
