/* principal: the main directions in which long vectors differ from their mean. Few vectors (tens to hundreds), each of
 * 10^4 to 10^6 coordinates, so that the matrix of their inner products is small: its eigenvectors are LAPACK's.
 *
 * Lengths are weighted, |x|^2 = sum weight[i] x[i]^2, so that coordinates that stand for more area or volume count for
 * more, however many of them there are. Coefficients are in standard deviations of their mode:
 *     x = mean + sum_k p[k] sd[k] mode[k]
 * The same bits for any number of threads. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct principal {
    int32_t length, sample_count, mode_count;
    double *weight;  /* [length] as given */
    double *mean;    /* [length] */
    double *mode;    /* [mode_count*length] of weighted length 1, each across the others; of its coordinates of at least
                      * 0.9 of the largest the first is positive */
    double *sd;      /* [mode_count] falling */
    double variance; /* of the samples in all directions: sum |x - mean|^2 / (sample_count - 1) */
} principal;

/* sample[sample_count] point to [length] coordinates each; weight[length] >= 0. At most `most_modes` modes, fewer where
 * the samples have fewer. The caller frees *out. Refuses (ERR_GEOMETRY) fewer than two samples, coordinates that are
 * not finite, samples that are all alike. */
bool principal_learn(const double *const *sample, int32_t sample_count, int32_t length, const double *weight,
                     int32_t most_modes, principal *out, err *e) MUST_CHECK;
void principal_free(principal *m);
/* Share of the variance that mode k has. */
double principal_share(const principal *m, int32_t k);

/* p[mode_count] of the vector x[length]. */
void principal_project(const principal *m, const double *x, double *p);
/* The same where only some of x is known, known[length] from 0 (missing) to 1: the likeliest p, by least squares with
 * the variances of the modes as prior and noise > 0, in the unit of x, as standard deviation of a coordinate of mean
 * weight. Refuses (ERR_GEOMETRY) where nothing is known. */
bool principal_complete(const principal *m, const double *x, const double *known, double noise, double *p,
                        err *e) MUST_CHECK;
/* x[length] of the coefficients p[count], count <= mode_count; those that are not given are 0. */
void principal_make(const principal *m, const double *p, int32_t count, double *x);

/* How well each sample is made from all others: with their mean and their modes, at most most_modes. */
typedef struct principal_left_out {
    int32_t sample_count, mode_count;
    double *mixture; /* [sample_count*sample_count] row s: shares of the samples that make s; sum 1, its own 0 */
    double *rms;     /* [mode_count+1] weighted error with so many modes, root of the mean square over the samples */
} principal_left_out;
/* Refuses (ERR_GEOMETRY) fewer than three samples, and what principal_learn refuses. The caller frees *out. */
bool principal_leave_out(const double *const *sample, int32_t sample_count, int32_t length, const double *weight,
                         int32_t most_modes, principal_left_out *out, err *e) MUST_CHECK;
/* x[length] of sample s, made from the others. */
void principal_left_out_make(const principal_left_out *l, const double *const *sample, int32_t length, int32_t s,
                             double *x);
void principal_left_out_free(principal_left_out *l);

#ifdef __cplusplus
}
#endif
