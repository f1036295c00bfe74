/* clash: how two bones stand to each other once one of them has moved: overlap, depth, distance.
 *
 * Bodies stay where they are at rest; queries are carried instead. rel takes the moved body into the frame of the
 * still one. All queries are const and thread-safe, and give the same bits on any number of threads. */
#pragma once
#include "geometry/distance_tree.h"
#include "geometry/rigid.h"
#include "geometry/solid_grid.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct clash_params {
    double cell_mm;      /* of the lattice that measures volumes; 0: the body is never the moved one of clash_volume */
    double step_mm;      /* of the grid that tells inside from outside; smaller is faster and needs more memory */
    double tolerance_mm; /* of depths and distances */
    const double *box;   /* [6] low, high: only this part of the body takes part in the queries; NULL: all of it */
} clash_params;

clash_params clash_params_default(void); /* 0.7, 0.7, 0.02, all */

typedef struct clash_body clash_body;

/* Borrows s (closed, outward) until clash_body_free. kind[triangle_count] (may be NULL: all 1) puts every triangle
 * into sets, as bits. Refuses what solid_grid_make refuses. */
bool clash_body_make(const surface *s, const uint8_t *kind, const clash_params *p, clash_body **out, err *e) MUST_CHECK;
void clash_body_free(clash_body **b); /* idempotent */

const solid_grid *clash_body_grid(const clash_body *b);
const distance_tree *clash_body_tree(const clash_body *b);

/* mm^3 that both fill, to about 1 %: every cell of the moved body's lattice stands for its own bone. */
double clash_volume(const clash_body *still, const clash_body *moved, const rigid *rel);

typedef struct clash_spot {
    double mm;
    double place[3]; /* frame of the still body */
    bool found;
} clash_spot;

/* The deepest point of one body's surface within the other, of the triangles whose kind has a bit of `kinds` (those of
 * the body that enters): distance to the other's surface. mm 0 and not found where they are apart. */
clash_spot clash_depth(const clash_body *still, const clash_body *moved, const rigid *rel, unsigned kinds);

/* The least distance of one body's triangles of `kinds` from the other body, at most `reach_mm` (not found: beyond). 0
 * where they touch or overlap. */
clash_spot clash_distance(const clash_body *still, const clash_body *moved, const rigid *rel, unsigned kinds,
                          double reach_mm);

#ifdef __cplusplus
}
#endif
