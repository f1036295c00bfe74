/* Each sample from the modes of all others. All of it happens in the matrix of inner products: that of the others is a
 * part of it, about another mean. */
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sim/principal.h"
#include "sim/src/identity/gram.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

typedef struct others {
    int32_t n;      /* how many */
    double *gram;   /* [n*n] about their own mean */
    double *toward; /* [n] products of the sample left out, from that mean, with each of them */
    double square;  /* of the sample's distance from that mean */
    double *value, *vector;
} others;

static others others_new(int32_t n)
{
    size_t k = (size_t)n;
    return (others){n, NEW_ARRAY(double, k *k), NEW_ARRAY(double, k), 0, NEW_ARRAY(double, k), NEW_ARRAY(double, k *k)};
}

static void others_free(others *o)
{
    free(o->gram);
    free(o->toward);
    free(o->value);
    free(o->vector);
}

/* From products about any centre: those of all but sample s, about the mean of these. */
static void leave(const double *gram, int32_t count, int32_t s, others *o)
{
    int32_t n = count - 1;
    double *row = NEW_ARRAY(double, n), all = 0, own = 0;
    for (int32_t i = 0; i < n; i++) {
        const double *g = gram + (size_t)(i < s ? i : i + 1) * count;
        for (int32_t j = 0; j < n; j++) row[i] += g[j < s ? j : j + 1] / n;
        all += row[i] / n;
        own += g[s] / n;
    }
    for (int32_t i = 0; i < n; i++) {
        const double *g = gram + (size_t)(i < s ? i : i + 1) * count;
        for (int32_t j = 0; j < n; j++) o->gram[(size_t)i * n + j] = g[j < s ? j : j + 1] - row[i] - row[j] + all;
        o->toward[i] = g[s] - own - row[i] + all;
    }
    o->square = gram[(size_t)s * count + s] - 2 * own + all;
    free(row);
}

/* Adds to square[k] what is left with k modes; share[count] becomes the mixture that uses all of them. */
static void rebuild(const others *o, int32_t most, int32_t s, double *share, double *square)
{
    int32_t n = o->n, rank = gram_rank(o->value, n - 1, most);
    double left = o->square;
    square[0] += left;
    for (int32_t i = 0; i <= n; i++) share[i] = i == s ? 0 : 1.0 / n;
    for (int32_t k = 0; k < most; k++) {
        const double *u = o->vector + (size_t)k * n;
        double along = 0, sum = 0;
        if (k < rank) {
            for (int32_t i = 0; i < n; i++) along += u[i] * o->toward[i];
            for (int32_t i = 0; i < n; i++) sum += u[i] / n;
            for (int32_t i = 0; i < n; i++) share[i < s ? i : i + 1] += along / o->value[k] * (u[i] - sum);
            left -= along * along / o->value[k];
        }
        square[k + 1] += fmax(left, 0);
    }
}

bool principal_leave_out(const double *const *sample, int32_t sample_count, int32_t length, const double *weight,
                         int32_t most_modes, principal_left_out *out, err *e)
{
    assert(length > 0 && most_modes > 0);
    if (sample_count < 3)
        return err_set(e, ERR_GEOMETRY, "%d samples: leaving one out needs at least three", sample_count);
    size_t n = (size_t)sample_count;
    int32_t modes = most_modes < sample_count - 2 ? most_modes : sample_count - 2;
    principal_left_out l = {sample_count, modes, NEW_ARRAY(double, n *n), NEW_ARRAY(double, modes + 1)};
    double *mean = NEW_ARRAY(double, length), *gram = NEW_ARRAY(double, n *n);
    others o = others_new(sample_count - 1);
    bool ok = gram_mean(sample, sample_count, length, mean, e);
    if (ok) gram_make(sample, sample_count, length, mean, weight, gram);
    for (int32_t s = 0; ok && s < sample_count; s++) {
        leave(gram, sample_count, s, &o);
        ok = gram_eigen(o.gram, o.n, o.value, o.vector, e);
        if (ok) rebuild(&o, modes, s, l.mixture + (size_t)s * n, l.rms);
    }
    for (int32_t k = 0; k <= modes; k++) l.rms[k] = sqrt(l.rms[k] / sample_count);
    others_free(&o);
    free(mean);
    free(gram);
    if (ok)
        *out = l;
    else
        principal_left_out_free(&l);
    return ok;
}

typedef struct mix_work {
    const double *const *sample;
    const double *share;
    double *x;
    int32_t count;
} mix_work;

static void mix_block(int64_t begin, int64_t end, void *context)
{
    const mix_work *w = context;
    for (int64_t i = begin; i < end; i++) w->x[i] = 0;
    for (int32_t s = 0; s < w->count; s++)
        for (int64_t i = begin; i < end; i++) w->x[i] += w->share[s] * w->sample[s][i];
}

void principal_left_out_make(const principal_left_out *l, const double *const *sample, int32_t length, int32_t s,
                             double *x)
{
    const double *share = l->mixture + (size_t)s * l->sample_count;
    parallel_for(length, 4096, mix_block, &(mix_work){sample, share, x, l->sample_count});
}

void principal_left_out_free(principal_left_out *l)
{
    free(l->mixture);
    free(l->rms);
    *l = (principal_left_out){0};
}
