/* distance_field: signed distance to a closed surface, made smooth. Positive outside.
 *
 * Exact distances on a grid, blended by cubic B-splines: twice continuously differentiable wherever a node comes
 * to lie, also between two teeth and inside a cusp, where the distance itself has creases. It differs from
 * the exact distance by step^2/6 times its Laplacian (the sum of the principal curvatures): at steps of 0.5 mm
 * by 0.04 mm on a ball of 2 mm, outward. Grid values are found when they are first asked for, unless they were kept. */
#pragma once
#include "geometry/nearest.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct distance_field distance_field; /* values may be asked for by several threads at once */

typedef struct distance_value {
    double d, grad[3], hess[9]; /* mm; d is HUGE_VAL well beyond reach_mm outside */
} distance_value;

enum { DISTANCE_BLOCK_SIDE = 4, DISTANCE_BLOCK = 64 }; /* samples along a block, in it */

/* Some blocks of a field's grid, to be kept. */
typedef struct distance_samples {
    int32_t count;
    int32_t *block; /* [count] numbers, ascending */
    float *centre;  /* [count] signed distance of its middle, mm */
    float *value;   /* [64*count] of its samples, x fastest */
} distance_samples;
void distance_samples_free(distance_samples *s); /* idempotent */

/* low, high: bounds of the surface. `of` is borrowed until distance_field_destroy. */
distance_field *distance_field_create(const nearest *of, const double low[3], const double high[3], double step_mm,
                                      double reach_mm);
void distance_field_destroy(distance_field **f);
/* Finds all that is asked of the field within about_mm (along each axis) of xyz[3*count], a NaN being nowhere: the same
 * values as when asked for one by one. The caller frees. */
distance_samples distance_field_find(const distance_field *f, const double *xyz, int32_t count, double about_mm);
/* Lends it what a field of the same surface found, until distance_field_destroy and before anything is asked. */
void distance_field_lend(distance_field *f, const distance_samples *s);
/* Are these numbers, of blocks that a field of these bounds has? */
bool distance_samples_sound(const distance_samples *s, const double low[3], const double high[3], double step_mm,
                            double reach_mm);
/* with_hess false leaves hess as it is. */
void distance_field_at(const distance_field *f, const double x[3], bool with_hess, distance_value *out);
/* Where the way from x along the unit direction leaves the surface's inside for the last time within reach_mm, and the
 * unit normal of the smooth distance there; false: it does not. */
bool distance_field_leave(const distance_field *f, const double x[3], const double direction[3], double reach_mm,
                          double hit[3], double normal[3]);

#ifdef __cplusplus
}
#endif
