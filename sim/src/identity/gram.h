/* gram: inner products of a few long vectors, and the eigenvectors of small symmetric matrices. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>

/* sum weight[i] (a[i] - centre[i]) (b[i] - centre[i]), summed in an order of its own. */
double gram_product(const double *a, const double *b, const double *centre, const double *weight, int32_t length);
/* mean[length] of the samples. Refuses (ERR_GEOMETRY) a coordinate that is not finite. */
bool gram_mean(const double *const *sample, int32_t count, int32_t length, double *mean, err *e) MUST_CHECK;
/* gram[count*count] of the samples about their mean. */
void gram_make(const double *const *sample, int32_t count, int32_t length, const double *mean, const double *weight,
               double *gram);
/* Eigenvalues falling, value[n], and their unit vectors, vector[n*n] one after the other, of the symmetric a[n*n],
 * which is lost. Refuses (ERR_INTERNAL) where LAPACK does not converge. */
bool gram_eigen(double *a, int32_t n, double *value, double *vector, err *e) MUST_CHECK;
/* How many of the falling eigenvalues are more than rounding, at most `most`. */
int32_t gram_rank(const double *value, int32_t n, int32_t most);
