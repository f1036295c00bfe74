#include "sim/src/identity/gram.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* LAPACK; the lengths of the texts come last, as Fortran compilers pass them. */
extern void dsyevd_(const char *job, const char *part, const int *n, double *a, const int *lda, double *w, double *work,
                    const int *work_size, int *iwork, const int *iwork_size, int *info, size_t job_size,
                    size_t part_size);
/* OpenBLAS only; other BLAS libraries keep their own setting. */
extern void openblas_set_num_threads(int) __attribute__((weak));

double gram_product(const double *a, const double *b, const double *centre, const double *weight, int32_t length)
{
    double sum[4] = {0}; /* four lanes: the order of the sum is fixed, and the compiler may use vectors */
    int32_t i = 0;
    for (; i + 4 <= length; i += 4)
        for (int32_t k = 0; k < 4; k++)
            sum[k] += weight[i + k] * (a[i + k] - centre[i + k]) * (b[i + k] - centre[i + k]);
    for (; i < length; i++) sum[0] += weight[i] * (a[i] - centre[i]) * (b[i] - centre[i]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

typedef struct mean_work {
    const double *const *sample;
    double *mean;
    int32_t count;
} mean_work;

static void mean_block(int64_t begin, int64_t end, void *context)
{
    const mean_work *w = context;
    for (int64_t i = begin; i < end; i++) w->mean[i] = 0;
    for (int32_t s = 0; s < w->count; s++)
        for (int64_t i = begin; i < end; i++) w->mean[i] += w->sample[s][i];
    for (int64_t i = begin; i < end; i++) w->mean[i] /= w->count;
}

bool gram_mean(const double *const *sample, int32_t count, int32_t length, double *mean, err *e)
{
    parallel_for(length, 4096, mean_block, &(mean_work){sample, mean, count});
    for (int32_t i = 0; i < length; i++) {
        if (isfinite(mean[i])) continue;
        int32_t s = 0;
        while (s < count - 1 && isfinite(sample[s][i])) s++;
        return err_set(e, ERR_GEOMETRY, "coordinate %d of sample %d is not a finite number", i, s);
    }
    return true;
}

typedef struct gram_work {
    const double *const *sample;
    const double *mean, *weight;
    double *gram;
    int32_t count, length;
} gram_work;

/* One row of the lower triangle; pieces of the vectors that stay in the cache are taken one after the other. */
static void gram_rows(int64_t begin, int64_t end, void *context)
{
    enum { PIECE = 4096 };
    const gram_work *w = context;
    for (int64_t s = begin; s < end; s++) {
        double *row = w->gram + s * w->count;
        for (int32_t i = 0; i < w->length; i += PIECE) {
            int32_t n = w->length - i < PIECE ? w->length - i : PIECE;
            for (int64_t t = 0; t <= s; t++)
                row[t] += gram_product(w->sample[s] + i, w->sample[t] + i, w->mean + i, w->weight + i, n);
        }
    }
}

void gram_make(const double *const *sample, int32_t count, int32_t length, const double *mean, const double *weight,
               double *gram)
{
    memset(gram, 0, sizeof *gram * (size_t)count * (size_t)count);
    parallel_for(count, 1, gram_rows, &(gram_work){sample, mean, weight, gram, count, length});
    for (int64_t s = 0; s < count; s++)
        for (int64_t t = 0; t < s; t++) gram[t * count + s] = gram[s * count + t];
}

bool gram_eigen(double *a, int32_t n, double *value, double *vector, err *e)
{
    int order = n, info = 0, size = 1 + 6 * n + 2 * n * n, isize = 3 + 5 * n;
    double *work = NEW_ARRAY(double, size);
    int *iwork = NEW_ARRAY(int, isize);
    if (openblas_set_num_threads) openblas_set_num_threads(1); /* the same bits for any number */
    dsyevd_("V", "L", &order, a, &order, value, work, &size, iwork, &isize, &info, 1, 1);
    free(work);
    free(iwork);
    if (info) return err_set(e, ERR_INTERNAL, "LAPACK's dsyevd does not converge (info %d)", info);
    for (int32_t k = 0; k < n; k++) memcpy(vector + (size_t)k * n, a + (size_t)(n - 1 - k) * n, sizeof(double) * n);
    for (int32_t k = 0; k < n / 2; k++) {
        double other = value[k];
        value[k] = value[n - 1 - k];
        value[n - 1 - k] = other;
    }
    return true;
}

int32_t gram_rank(const double *value, int32_t n, int32_t most)
{
    int32_t rank = 0;
    while (rank < n && rank < most && value[rank] > 1e-12 * value[0]) rank++;
    return rank;
}
