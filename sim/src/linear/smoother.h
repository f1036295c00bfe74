/* smoother: one level of multigrid, and Chebyshev polynomials of its block-Jacobi iteration, which damp what
 * a coarser level cannot see (Adams, Brezina, Hu, Tuminaro 2003). In single precision. */
#pragma once
#include "sim/src/linear/blocks.h"

typedef struct level {
    blocks a, p, r;       /* p, r: to and from the next level */
    float *inverse;       /* [9*rows] of the diagonal blocks */
    double top;           /* an upper estimate of the largest eigenvalue of inverse times a */
    float *b, *x, *y, *d; /* [3*rows] right side, solution, work; b NULL on the first level */
} level;

/* Rounds a; finds top. inverse is there. */
void smoother_make(level *l);
/* One polynomial step on A x = b from the present x, or from 0. */
void smoother_apply(level *l, const float *b, bool from_zero);
/* y = b - A x */
void smoother_residual(level *l, const float *b);
/* y = A x and y += A x for rounded blocks, such as p and r. */
void smoother_multiply(const blocks *a, const float *x, float *y);
void smoother_multiply_add(const blocks *a, const float *x, float *y);
