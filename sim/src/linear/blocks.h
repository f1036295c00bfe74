/* blocks: sparse matrices of 3x3 blocks, by rows, columns ascending. Products run in parallel, every row by
 * one thread in a fixed order, so bits do not depend on the number of threads. */
#pragma once
#include <stdbool.h>
#include <stdint.h>

typedef struct blocks {
    int32_t rows, columns; /* in blocks */
    int64_t *start;        /* [rows + 1] */
    int32_t *column;       /* [start[rows]] */
    double *value;         /* [9 * start[rows]] row-major blocks; NULL where only `single` is kept */
    float *single;
} blocks;

void blocks_free(blocks *a);
/* For qsort of int32_t: ascending. */
int blocks_by_number(const void *p, const void *q);
blocks blocks_transposed(const blocks *a);
/* a b */
blocks blocks_product(const blocks *a, const blocks *b);
/* y[3*rows] = A x[3*columns] */
void blocks_multiply(const blocks *a, const double *x, double *y);

/* Makes `single` of value: half the memory and time, for what only preconditions. */
void blocks_round(blocks *a);
/* Frees value. */
void blocks_keep_single(blocks *a);
/* sum[3] += row i of A times x */
static inline void blocks_single_row(const blocks *a, int64_t i, const float *x, float sum[3])
{
    float s0 = sum[0], s1 = sum[1], s2 = sum[2];
    for (int64_t k = a->start[i]; k < a->start[i + 1]; k++) {
        const float *b = a->single + 9 * k, *v = x + 3 * (int64_t)a->column[k];
        s0 += b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
        s1 += b[3] * v[0] + b[4] * v[1] + b[5] * v[2];
        s2 += b[6] * v[0] + b[7] * v[1] + b[8] * v[2];
    }
    sum[0] = s0;
    sum[1] = s1;
    sum[2] = s2;
}
