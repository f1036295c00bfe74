/* linear: A x = b for one fixed sparse pattern, symmetric positive definite, solved by supernodal Cholesky
 * (CHOLMOD, METIS ordering). Analysed once, factorised for many values. An indefinite matrix is reported,
 * never solved: the simplicial LDL^T would accept it and give a direction that does not descend. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct linear linear;

typedef struct linear_stats {
    int64_t unknown_count, matrix_entries; /* of the lower triangle */
    int64_t factor_entries;
    double factor_flops;   /* of one factorisation */
    double memory_peak_mb; /* of CHOLMOD */
    int factorisations, solves;
    double analyse_s, factor_s, solve_s; /* wall time, summed over calls */
} linear_stats;

/* Lower triangle by columns: rows row[start[j] .. start[j+1]) ascending, the diagonal first. Both arrays are
 * borrowed until linear_destroy. blas_threads 1 gives the same bits on every run; more is faster and changes
 * the last bits with their number. Refuses ERR_RESOURCE. */
bool linear_create(int64_t unknown_count, const int64_t *start, const int64_t *row, int blas_threads, linear **out,
                   err *e) MUST_CHECK;
void linear_destroy(linear **l);
/* Factorises A + shift I. *positive_definite false: there is no factor. Refuses ERR_RESOURCE. */
bool linear_factor(linear *l, const double *value, double shift, bool *positive_definite, err *e) MUST_CHECK;
/* x may alias b. Needs a factor. Refuses ERR_RESOURCE. */
bool linear_solve(linear *l, const double *b, double *x, err *e) MUST_CHECK;
linear_stats linear_measure(const linear *l);

#ifdef __cplusplus
}
#endif
