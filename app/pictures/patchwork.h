/* patchwork: where planned bones overlap or part, as loose coloured triangles. */
#pragma once
#include "geometry/clash.h"
#include "geometry/rigid.h"
#include "geometry/surface.h"

extern const double patchwork_red[3], patchwork_blue[3]; /* of overlap, of the widest gap */

typedef struct patchwork { /* loose triangles, each with its colour */
    surface s;
    int32_t room;
} patchwork;

/* Adds, in red, what of the bone lies within the other one. rel takes the bone to the other's place at rest, move to
 * where it is planned. The caller frees to->s. */
void patchwork_overlap(patchwork *to, const surface *bone, const clash_body *other, const rigid *rel,
                       const rigid *move);
/* Adds, the darker blue the wider, what of a cut's face has no bone opposite within the saw's width and a little;
 * `bone` is the surface of `other`. Refuses what nearest_create refuses. */
bool patchwork_gap(patchwork *to, const surface *face, const clash_body *other, const surface *bone, const rigid *rel,
                   const rigid *move, double saw_mm, err *e) MUST_CHECK;
