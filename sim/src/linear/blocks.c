#include "sim/src/linear/blocks.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <stdlib.h>
#include <string.h>

enum { MULTIPLY_GRAIN = 2048, PRODUCT_GRAIN = 2048 };

void blocks_free(blocks *a)
{
    free(a->start);
    free(a->column);
    free(a->value);
    free(a->single);
    *a = (blocks){0};
}

blocks blocks_transposed(const blocks *a)
{
    int64_t count = a->start[a->rows];
    blocks t = {.rows = a->columns,
                .columns = a->rows,
                .start = NEW_ARRAY(int64_t, (size_t)a->columns + 2),
                .column = NEW_ARRAY(int32_t, count),
                .value = NEW_ARRAY(double, 9 * count)};
    for (int64_t k = 0; k < count; k++) t.start[a->column[k] + 2]++;
    for (int32_t j = 0; j < a->columns; j++) t.start[j + 2] += t.start[j + 1];
    for (int32_t i = 0; i < a->rows; i++)
        for (int64_t k = a->start[i]; k < a->start[i + 1]; k++) {
            int64_t to = t.start[a->column[k] + 1]++;
            t.column[to] = i;
            for (int c = 0; c < 9; c++) t.value[9 * to + c] = a->value[9 * k + 3 * (c % 3) + c / 3];
        }
    return t;
}

typedef struct product_job {
    const blocks *a, *b;
    blocks *c;
    bool counting;
} product_job;

int blocks_by_number(const void *p, const void *q)
{
    int32_t a = *(const int32_t *)p, b = *(const int32_t *)q;
    return (a > b) - (a < b);
}

/* Rows of the product: first how many blocks, then which and what. */
static void product_body(int64_t begin, int64_t end, void *context)
{
    const product_job *job = context;
    const blocks *a = job->a, *b = job->b;
    blocks *c = job->c;
    int64_t *place = NEW_ARRAY(int64_t, b->columns); /* of a column: met in this row; then its place */
    for (int64_t i = begin; i < end; i++) {
        int64_t first = job->counting ? 0 : c->start[i], count = first;
        for (int64_t k = a->start[i]; k < a->start[i + 1]; k++)
            for (int64_t l = b->start[a->column[k]]; l < b->start[a->column[k] + 1]; l++) {
                int32_t j = b->column[l];
                if (place[j] == 0) {
                    place[j] = 1;
                    if (!job->counting) c->column[count] = j;
                    count++;
                }
            }
        if (job->counting) {
            c->start[i + 1] = count;
            for (int64_t k = a->start[i]; k < a->start[i + 1]; k++)
                for (int64_t l = b->start[a->column[k]]; l < b->start[a->column[k] + 1]; l++) place[b->column[l]] = 0;
            continue;
        }
        qsort(c->column + first, (size_t)(count - first), sizeof *c->column, blocks_by_number);
        for (int64_t k = first; k < count; k++) place[c->column[k]] = k;
        for (int64_t k = a->start[i]; k < a->start[i + 1]; k++)
            for (int64_t l = b->start[a->column[k]]; l < b->start[a->column[k] + 1]; l++) {
                const double *p = a->value + 9 * k, *q = b->value + 9 * l;
                double *out = c->value + 9 * place[b->column[l]];
                for (int r = 0; r < 3; r++)
                    for (int s = 0; s < 3; s++)
                        out[3 * r + s] += p[3 * r] * q[s] + p[3 * r + 1] * q[3 + s] + p[3 * r + 2] * q[6 + s];
            }
        for (int64_t k = first; k < count; k++) place[c->column[k]] = 0;
    }
    free(place);
}

blocks blocks_product(const blocks *a, const blocks *b)
{
    blocks c = {.rows = a->rows, .columns = b->columns, .start = NEW_ARRAY(int64_t, (size_t)a->rows + 1)};
    product_job job = {a, b, &c, true};
    parallel_for(a->rows, PRODUCT_GRAIN, product_body, &job);
    for (int32_t i = 0; i < c.rows; i++) c.start[i + 1] += c.start[i];
    c.column = NEW_ARRAY(int32_t, c.start[c.rows]);
    c.value = NEW_ARRAY(double, 9 * c.start[c.rows]);
    job.counting = false;
    parallel_for(a->rows, PRODUCT_GRAIN, product_body, &job);
    return c;
}

typedef struct multiply_job {
    const blocks *a;
    const double *x;
    double *y;
} multiply_job;

static void multiply_body(int64_t begin, int64_t end, void *context)
{
    const multiply_job *job = context;
    const blocks *a = job->a;
    for (int64_t i = begin; i < end; i++) {
        double s0 = 0, s1 = 0, s2 = 0;
        for (int64_t k = a->start[i]; k < a->start[i + 1]; k++) {
            const double *b = a->value + 9 * k, *v = job->x + 3 * (int64_t)a->column[k];
            s0 += b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
            s1 += b[3] * v[0] + b[4] * v[1] + b[5] * v[2];
            s2 += b[6] * v[0] + b[7] * v[1] + b[8] * v[2];
        }
        job->y[3 * i] = s0;
        job->y[3 * i + 1] = s1;
        job->y[3 * i + 2] = s2;
    }
}

void blocks_multiply(const blocks *a, const double *x, double *y)
{
    multiply_job job = {a, x, y};
    parallel_for(a->rows, MULTIPLY_GRAIN, multiply_body, &job);
}

void blocks_round(blocks *a)
{
    int64_t count = 9 * a->start[a->rows];
    a->single = NEW_ARRAY(float, count);
    for (int64_t i = 0; i < count; i++) a->single[i] = (float)a->value[i];
}

void blocks_keep_single(blocks *a)
{
    free(a->value);
    a->value = NULL;
}
