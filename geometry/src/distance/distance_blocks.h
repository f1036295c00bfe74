/* distance_blocks: the inside of a distance_field, for those who fill and keep it. */
#pragma once
#include "geometry/distance_field.h"
#include <stdatomic.h>

enum { SIDE = DISTANCE_BLOCK_SIDE, BLOCK = SIDE * SIDE * SIDE }; /* samples are found by the block */

struct distance_field {
    const nearest *of;
    double low[3], step, reach;
    int32_t blocks[3];
    _Atomic(float) *centre;        /* [blocks0*blocks1*blocks2] signed distance of its middle, NaN until asked for */
    _Atomic(const float *) *block; /* its samples, NULL until asked for */
    const distance_samples *lent;  /* whose are some of them; may be NULL */
};

/* First sample and blocks along each axis; returns how many blocks in all. */
int64_t block_grid(const double low[3], const double high[3], double step_mm, double reach_mm, double first[3],
                   int32_t blocks[3]);

static inline size_t block_slot(const distance_field *f, const int32_t at[3])
{
    return ((size_t)at[2] * (size_t)f->blocks[1] + (size_t)at[1]) * (size_t)f->blocks[0] + (size_t)at[0];
}

/* Is all of the block farther outside than the reach? */
bool block_is_far(const distance_field *f, const int32_t at[3]);
/* Its samples, x fastest. */
const float *block_get(const distance_field *f, const int32_t at[3]);
