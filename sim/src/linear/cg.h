/* cg: conjugate gradients for a symmetric matrix of blocks, preconditioned by multigrid. */
#pragma once
#include "sim/src/linear/multigrid.h"

typedef struct cg_result {
    int iterations;
    double reduction; /* of the residual's norm */
    bool indefinite;  /* a direction without curvature was met: x is the last iterate before it */
} cg_result;

/* x from 0 until the residual has fallen to rel_tol or max_iterations are done. While the matrix shows itself
 * positive definite every iterate lowers x.Ax/2 - b.x. Refuses what multigrid_apply refuses. */
bool cg_solve(const blocks *a, multigrid *m, const double *b, double *x, double rel_tol, int max_iterations,
              cg_result *out, err *e) MUST_CHECK;
