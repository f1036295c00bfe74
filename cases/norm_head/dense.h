/* dense: a small dense linear system, for the interpolations of the norm head. */
#pragma once

/* Solves A x = b for `columns` right-hand sides: a[n*n] row-major is destroyed, b[n*columns] becomes x.
 * Partial pivoting; asserts that A is not singular. */
void dense_solve(double *a, double *b, int n, int columns);
