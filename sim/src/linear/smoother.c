#include "sim/src/linear/smoother.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <math.h>
#include <string.h>

enum { DEGREE = 2, POWER_STEPS = 12, ROW_GRAIN = 4096 };
static const double smoothed_part = 15; /* eigenvalues are damped down to this part of the largest */
static const double safety = 1.1;       /* power iteration sees the largest from below */

typedef struct smooth_job {
    const level *l;
    const float *b, *x; /* NULL: zero */
    float *y, *d, keep, move;
} smooth_job;

/* d = keep d + move inverse (b - A x); y = x + d */
static void smooth_body(int64_t begin, int64_t end, void *context)
{
    const smooth_job *job = context;
    for (int64_t i = begin; i < end; i++) {
        const float *m = job->l->inverse + 9 * i;
        float ax[3] = {0}, r[3] = {0}, *d = job->d + 3 * i;
        if (job->x) blocks_single_row(&job->l->a, i, job->x, ax);
        for (int c = 0; c < 3; c++) r[c] = (job->b ? job->b[3 * i + c] : 0) - ax[c];
        for (int c = 0; c < 3; c++) {
            float z = m[3 * c] * r[0] + m[3 * c + 1] * r[1] + m[3 * c + 2] * r[2];
            d[c] = job->keep * d[c] + job->move * z;
            job->y[3 * i + c] = (job->x ? job->x[3 * i + c] : 0) + d[c];
        }
    }
}

/* Saad 2003, algorithm 12.1. */
void smoother_apply(level *l, const float *b, bool from_zero)
{
    double high = l->top, low = l->top / smoothed_part;
    double centre = (high + low) / 2, half = (high - low) / 2, rho = half / centre;
    smooth_job job = {.l = l, .b = b, .d = l->d, .keep = 0, .move = (float)(1 / centre)};
    for (int k = 0; k < DEGREE; k++) {
        job.x = k == 0 && from_zero ? NULL : l->x;
        job.y = l->y;
        parallel_for(l->a.rows, ROW_GRAIN, smooth_body, &job);
        l->y = l->x;
        l->x = job.y;
        double next = 1 / (2 * centre / half - rho);
        job.keep = (float)(next * rho);
        job.move = (float)(2 * next / half);
        rho = next;
    }
}

void smoother_make(level *l)
{
    size_t n = 3 * (size_t)l->a.rows;
    uint64_t state = 1;
    blocks_round(&l->a);
    for (size_t i = 0; i < n; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        l->x[i] = (float)(state >> 40) / (1 << 23) - 1;
    }
    smooth_job job = {.l = l, .d = l->d, .keep = 0, .move = -1}; /* d = inverse A x */
    for (int k = 0; k < POWER_STEPS; k++) {
        double before = 0, after = 0;
        for (size_t i = 0; i < n; i++) before += (double)l->x[i] * (double)l->x[i];
        job.x = l->x;
        job.y = l->y;
        parallel_for(l->a.rows, ROW_GRAIN, smooth_body, &job);
        for (size_t i = 0; i < n; i++) after += (double)l->d[i] * (double)l->d[i];
        l->top = safety * sqrt(after / before);
        for (size_t i = 0; i < n; i++) l->x[i] = (float)((double)l->d[i] / sqrt(after));
    }
    memset(l->d, 0, n * sizeof *l->d);
}

static void residual_body(int64_t begin, int64_t end, void *context)
{
    const smooth_job *job = context;
    for (int64_t i = begin; i < end; i++) {
        float ax[3] = {0};
        blocks_single_row(&job->l->a, i, job->x, ax);
        for (int c = 0; c < 3; c++) job->y[3 * i + c] = job->b[3 * i + c] - ax[c];
    }
}

void smoother_residual(level *l, const float *b)
{
    smooth_job job = {.l = l, .b = b, .x = l->x, .y = l->y};
    parallel_for(l->a.rows, ROW_GRAIN, residual_body, &job);
}

typedef struct multiply_job {
    const blocks *a;
    const float *x;
    float *y;
} multiply_job;

static void add_body(int64_t begin, int64_t end, void *context)
{
    const multiply_job *job = context;
    for (int64_t i = begin; i < end; i++) blocks_single_row(job->a, i, job->x, job->y + 3 * i);
}

void smoother_multiply_add(const blocks *a, const float *x, float *y)
{
    multiply_job job = {a, x, y};
    parallel_for(a->rows, ROW_GRAIN, add_body, &job);
}

void smoother_multiply(const blocks *a, const float *x, float *y)
{
    memset(y, 0, 3 * (size_t)a->rows * sizeof *y);
    smoother_multiply_add(a, x, y);
}
