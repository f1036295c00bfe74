/* targets: places in the world that points of the tissue are drawn to by springs.
 *
 * Point k lies in tet tet[k] at barycentric weights weight[4k..], which sum to 1 and may be negative (outside its tet).
 * With d = its place in the tissue minus place[k], n = normal[k], s = stiffness[k] and a = across[k] its energy is
 *   s/2 (n.d)^2 + a s/2 (|d|^2 - (n.d)^2):
 * a = 0 draws it to the plane through place across n, a = 1 to the place itself. Quadratic: the Hessian does not depend
 * on where the tissue is. */
#pragma once
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct targets {
    int32_t count;
    int32_t *tet;      /* [count] */
    double *weight;    /* [4*count] */
    double *place;     /* [3*count] mm */
    double *normal;    /* [3*count] unit */
    double *stiffness; /* [count] mN/mm, 0: not drawn */
    double *across;    /* [count] 0..1 */
} targets;

targets targets_new(int32_t count); /* zeroed arrays */
void targets_free(targets *t);      /* idempotent */
/* Refuses (ERR_INPUT) a tet out of range, weights that do not sum to 1, a stiffness below 0, a share outside 0..1, a
 * normal that is not of length 1, and what is not finite: the first offender is named. */
bool targets_check(const targets *t, const tetmesh *m, err *e) MUST_CHECK;
/* Where point k is in the tissue at x[3*nodes]. */
void targets_point(const targets *t, const tetmesh *m, const double *x, int32_t k, double out[3]);

#ifdef __cplusplus
}
#endif
