/* svd3: small dense decompositions. Matrices row-major. */
#pragma once

/* F = U diag(s) V^T with U, V rotations; s[0] >= s[1] >= |s[2]|, and s[2] carries the sign of det F.
 * One-sided Jacobi (Hestenes): accurate also for small s. */
void svd3(const double F[9], double U[9], double s[3], double V[9]);

enum { EIGEN_MAX = 9 };
/* A symmetric n x n (n <= EIGEN_MAX), destroyed; value[k] ascending is not promised; vector k is column k of
 * Q. */
void symmetric_eigen(int n, double *A, double *value, double *Q);
