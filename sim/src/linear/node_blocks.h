/* node_blocks: the matrix of the unknowns as blocks of nodes. */
#pragma once
#include "sim/assemble.h"
#include "sim/src/linear/blocks.h"

/* Unknown q is component place[q] % 3 of block place[q] / 3. */
typedef struct node_blocks {
    int32_t unknown_count, block_count;
    int32_t *place; /* [unknown_count] */
} node_blocks;

node_blocks node_blocks_make(const boundary *b);
void node_blocks_free(node_blocks *f);
/* Both triangles of the assembly's matrix; caller frees. */
blocks node_blocks_matrix(const node_blocks *f, const assembly *a);
/* Fills the values of such a matrix. */
void node_blocks_fill(const node_blocks *f, const assembly *a, const double *value, blocks *out);
/* Rigid motions of the nodes at x[3*nodes] as the unknowns see them; [18*block_count], caller frees. */
double *node_blocks_modes(const node_blocks *f, const boundary *b, const double *x);
/* v[3*block_count] = z[unknown_count], zero where no unknown is; and back. */
void node_blocks_scatter(const node_blocks *f, const double *z, double *v);
void node_blocks_gather(const node_blocks *f, const double *v, double *z);
