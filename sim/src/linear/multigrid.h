/* multigrid: an approximate inverse of a stiffness matrix for conjugate gradients, in time and memory
 * proportional to its size. One V-cycle in single precision over levels of smoothed aggregation, which are
 * made in double; the last level is factorised. Symmetric, and positive definite where the matrix is. */
#pragma once
#include "geometry/err.h"
#include "sim/src/linear/blocks.h"

typedef struct multigrid multigrid;

/* modes[18*rows]: rigid motions, see aggregate.h. *definite false: the matrix is not, and *out is NULL.
 * Refuses ERR_RESOURCE. */
bool multigrid_make(const blocks *a, const double *modes, multigrid **out, bool *definite, err *e) MUST_CHECK;
void multigrid_destroy(multigrid **m);
/* x = approximately A^-1 b; vectors of 3*rows. Refuses ERR_RESOURCE. */
bool multigrid_apply(multigrid *m, const double *b, double *x, err *e) MUST_CHECK;
/* Of all matrices, transfers and vectors. */
double multigrid_mb(const multigrid *m);
