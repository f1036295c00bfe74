/* distance_field: signed distance to a closed surface, made smooth. Positive outside.
 *
 * Exact distances on a grid, blended by cubic B-splines: twice continuously differentiable wherever a node comes
 * to lie, also between two teeth and inside a cusp, where the distance itself has creases. It differs from
 * the exact distance by step^2/6 times its Laplacian (the sum of the principal curvatures): at steps of 0.5 mm
 * by 0.04 mm on a ball of 2 mm, outward. Grid values are found when they are first asked for. */
#pragma once
#include "geometry/nearest.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct distance_field distance_field; /* values may be asked for by several threads at once */

typedef struct distance_value {
    double d, grad[3], hess[9]; /* mm; d is HUGE_VAL well beyond reach_mm outside */
} distance_value;

/* low, high: bounds of the surface. `of` is borrowed until distance_field_destroy. */
distance_field *distance_field_create(const nearest *of, const double low[3], const double high[3], double step_mm,
                                      double reach_mm);
void distance_field_destroy(distance_field **f);
/* with_hess false leaves hess as it is. */
void distance_field_at(const distance_field *f, const double x[3], bool with_hess, distance_value *out);
/* Where the way from x along the unit direction leaves the surface's inside for the last time within reach_mm, and the
 * unit normal of the smooth distance there; false: it does not. */
bool distance_field_leave(const distance_field *f, const double x[3], const double direction[3], double reach_mm,
                          double hit[3], double normal[3]);

#ifdef __cplusplus
}
#endif
