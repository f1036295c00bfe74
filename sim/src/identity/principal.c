#include "sim/principal.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sim/src/identity/gram.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct mode_work {
    const double *const *sample;
    const double *vector; /* eigenvectors of the Gram matrix over the root of their eigenvalue */
    principal *m;
} mode_work;

static void mode_block(int64_t begin, int64_t end, void *context)
{
    const mode_work *w = context;
    const principal *m = w->m;
    for (int32_t k = 0; k < m->mode_count; k++) {
        double *mode = m->mode + (size_t)k * m->length;
        for (int32_t s = 0; s < m->sample_count; s++) {
            double share = w->vector[(size_t)k * m->sample_count + s];
            for (int64_t i = begin; i < end; i++) mode[i] += share * (w->sample[s][i] - m->mean[i]);
        }
    }
}

/* An eigenvector and its negative are as good: one is agreed on that rounding and the order of samples do not change.
 */
static void fix_sign(double *mode, int32_t length)
{
    double largest = 0;
    for (int32_t i = 0; i < length; i++) largest = fmax(largest, fabs(mode[i]));
    int32_t first = 0;
    while (fabs(mode[first]) < 0.9 * largest) first++;
    if (mode[first] > 0) return;
    for (int32_t i = 0; i < length; i++) mode[i] = -mode[i];
}

static void make_modes(principal *m, const double *const *sample, const double *value, double *vector)
{
    m->mode = NEW_ARRAY(double, (size_t)m->mode_count * m->length);
    m->sd = NEW_ARRAY(double, m->mode_count);
    for (int32_t k = 0; k < m->mode_count; k++) {
        m->sd[k] = sqrt(value[k] / (m->sample_count - 1));
        for (int32_t s = 0; s < m->sample_count; s++) vector[(size_t)k * m->sample_count + s] /= sqrt(value[k]);
    }
    parallel_for(m->length, 512, mode_block, &(mode_work){sample, vector, m});
    for (int32_t k = 0; k < m->mode_count; k++) fix_sign(m->mode + (size_t)k * m->length, m->length);
}

bool principal_learn(const double *const *sample, int32_t sample_count, int32_t length, const double *weight,
                     int32_t most_modes, principal *out, err *e)
{
    assert(length > 0 && most_modes > 0);
    if (sample_count < 2)
        return err_set(e, ERR_GEOMETRY, "%d samples: modes need at least two that differ", sample_count);
    size_t n = (size_t)sample_count;
    principal m = {.length = length, .sample_count = sample_count, .mean = NEW_ARRAY(double, length)};
    double *gram = NEW_ARRAY(double, n *n), *value = NEW_ARRAY(double, n), *vector = NEW_ARRAY(double, n *n);
    bool ok = gram_mean(sample, sample_count, length, m.mean, e);
    if (ok) {
        gram_make(sample, sample_count, length, m.mean, weight, gram);
        for (size_t s = 0; s < n; s++) m.variance += gram[s * n + s] / (sample_count - 1);
        double size = 0;
        for (int32_t i = 0; i < length; i++) size += weight[i] * m.mean[i] * m.mean[i];
        ok = m.variance > 1e-24 * size || err_set(e, ERR_GEOMETRY, "the %d samples are all alike", sample_count);
    }
    ok = ok && gram_eigen(gram, sample_count, value, vector, e);
    if (ok) {
        m.weight = COPY_ARRAY(double, weight, length);
        m.mode_count = gram_rank(value, sample_count - 1, most_modes);
        make_modes(&m, sample, value, vector);
        *out = m;
    } else {
        principal_free(&m);
    }
    free(gram);
    free(value);
    free(vector);
    return ok;
}

void principal_free(principal *m)
{
    free(m->weight);
    free(m->mean);
    free(m->mode);
    free(m->sd);
    *m = (principal){0};
}

double principal_share(const principal *m, int32_t k) { return m->sd[k] * m->sd[k] / m->variance; }

typedef struct project_work {
    const principal *m;
    const double *x;
    double *p;
} project_work;

static void project_modes(int64_t begin, int64_t end, void *context)
{
    const project_work *w = context;
    const principal *m = w->m;
    for (int64_t k = begin; k < end; k++) {
        const double *mode = m->mode + (size_t)k * m->length;
        double sum = 0;
        for (int32_t i = 0; i < m->length; i++) sum += m->weight[i] * (w->x[i] - m->mean[i]) * mode[i];
        w->p[k] = sum / m->sd[k];
    }
}

void principal_project(const principal *m, const double *x, double *p)
{
    parallel_for(m->mode_count, 1, project_modes, &(project_work){m, x, p});
}

typedef struct make_work {
    const principal *m;
    const double *p;
    double *x;
    int32_t count;
} make_work;

static void make_block(int64_t begin, int64_t end, void *context)
{
    const make_work *w = context;
    const principal *m = w->m;
    for (int64_t i = begin; i < end; i++) w->x[i] = m->mean[i];
    for (int32_t k = 0; k < w->count; k++) {
        const double *mode = m->mode + (size_t)k * m->length;
        double size = w->p[k] * m->sd[k];
        for (int64_t i = begin; i < end; i++) w->x[i] += size * mode[i];
    }
}

void principal_make(const principal *m, const double *p, int32_t count, double *x)
{
    assert(count <= m->mode_count);
    parallel_for(m->length, 4096, make_block, &(make_work){m, p, x, count});
}
