/* The likeliest coefficients where only some of a vector is known. */
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sim/principal.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

typedef struct normal_work {
    const principal *m;
    const double *x, *heavy; /* [length] weight * known / (mean weight * noise^2) */
    double *matrix, *right;
} normal_work;

/* Row k of the normal equations, lower triangle. */
static void normal_rows(int64_t begin, int64_t end, void *context)
{
    const normal_work *w = context;
    const principal *m = w->m;
    for (int64_t k = begin; k < end; k++) {
        const double *a = m->mode + (size_t)k * m->length;
        for (int64_t j = 0; j <= k; j++) {
            const double *b = m->mode + (size_t)j * m->length;
            double sum = 0;
            for (int32_t i = 0; i < m->length; i++)
                if (w->heavy[i] > 0) sum += w->heavy[i] * a[i] * b[i];
            w->matrix[k * m->mode_count + j] = sum * m->sd[k] * m->sd[j] + (j == k ? 1 : 0);
        }
        double sum = 0;
        for (int32_t i = 0; i < m->length; i++)
            if (w->heavy[i] > 0) sum += w->heavy[i] * a[i] * (w->x[i] - m->mean[i]);
        w->right[k] = sum * m->sd[k];
    }
}

/* Cholesky in place; the matrix is the identity plus what is at least zero, so that no pivot vanishes. */
static void solve(double *a, double *b, int32_t n)
{
    for (int32_t k = 0; k < n; k++) {
        for (int32_t j = 0; j <= k; j++) {
            double sum = a[k * n + j];
            for (int32_t i = 0; i < j; i++) sum -= a[k * n + i] * a[j * n + i];
            a[k * n + j] = j == k ? sqrt(sum) : sum / a[j * n + j];
        }
        for (int32_t i = 0; i < k; i++) b[k] -= a[k * n + i] * b[i];
        b[k] /= a[k * n + k];
    }
    for (int32_t k = n - 1; k >= 0; k--) {
        for (int32_t i = k + 1; i < n; i++) b[k] -= a[i * n + k] * b[i];
        b[k] /= a[k * n + k];
    }
}

bool principal_complete(const principal *m, const double *x, const double *known, double noise, double *p, err *e)
{
    assert(noise > 0);
    double *heavy = NEW_ARRAY(double, m->length), total = 0, seen = 0;
    for (int32_t i = 0; i < m->length; i++) total += m->weight[i];
    for (int32_t i = 0; i < m->length; i++) {
        heavy[i] = m->weight[i] * known[i] * m->length / (total * noise * noise);
        seen += heavy[i];
    }
    bool ok = seen > 0 || err_set(e, ERR_GEOMETRY, "nothing is known of the vector that is to be completed");
    if (ok) {
        double *matrix = NEW_ARRAY(double, (size_t)m->mode_count * m->mode_count);
        parallel_for(m->mode_count, 1, normal_rows, &(normal_work){m, x, heavy, matrix, p});
        solve(matrix, p, m->mode_count);
        free(matrix);
    }
    free(heavy);
    return ok;
}
