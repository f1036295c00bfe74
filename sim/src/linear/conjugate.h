/* conjugate: conjugate gradients with the diagonal as preconditioner, for answers of two or three digits. */
#pragma once
#include <stdint.h>

/* out = A x; A symmetric positive definite, x and out [n]. */
typedef void conjugate_apply(const double *x, double *out, void *context);

/* Starts from x (usually zero) and stops where the preconditioned residual has fallen by rel_tol or after
 * max_iterations. Returns the number of iterations. Zero diagonal entries belong to rows that are left as
 * they are. */
int conjugate_solve(int64_t n, conjugate_apply *apply, void *context, const double *diagonal, const double *b,
                    double *x, double rel_tol, int max_iterations);
