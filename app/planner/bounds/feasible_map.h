/* feasible_map: what is feasible over two or three controls, on a regular grid that holds the base. */
#pragma once
#include "app/planner/bounds/sample_set.h"

typedef struct feasible_map_params {
    int axis_count, axis[3]; /* two or three controls */
    int32_t low[3], high[3]; /* box in steps, around 0, multiples of spacing */
    int32_t spacing;         /* of the grid */
    int32_t coarse;          /* steps between the points that are judged first, a multiple of spacing */
    bool reasons;            /* refine also where only the reason changes, outside what is fine */
    bool edges;              /* two controls: find where the level changes between neighbours to one step */
} feasible_map_params;

typedef struct feasible_map {
    feasible_map_params params;
    int32_t count[3]; /* nodes along each axis; 1 beyond axis_count */
    int64_t node_count;
    verdict *node;     /* [node_count], first axis fastest */
    uint8_t *judged;   /* [node_count] 0: not judged, equal corners stand around it; has the nearest one's verdict */
    uint8_t *behind;   /* [node_count] 1: not stopped, but a nearer point on the ray from the base is */
    double *edge[2];   /* NULL or [node_count] steps from the node along the axis to where the level changes, < 0: it
                          does not */
    bool base_stopped; /* then behind is not looked at */
    int64_t behind_count, level_count[3]; /* nodes by verdict_level */
    int64_t example;                      /* a node that is behind, and the point before it; -1 */
    int32_t before[SAMPLE_AXES_MAX];
} feasible_map;

/* Judges the coarse points, then halves every cell that holds points of different kinds down to the spacing. An island
 * narrower than `coarse` can be missed. Then looks from the base along the ray to every node that is not stopped: it is
 * marked as behind where a stopped node lies on the ray before it, or where the ray comes between nodes that are partly
 * stopped and the likeliest point there, judged as well, is. A ray that grazes a corner by less than 1.5 spacings can
 * be missed. The caller frees *out. Refuses what sample_set_ask refuses. */
bool feasible_map_find(sample_set *s, const feasible_map_params *p, feasible_map *out, err *e) MUST_CHECK;
void feasible_map_free(feasible_map *m); /* idempotent, leaves zero */

/* Steps from the base of a node: [SAMPLE_AXES_MAX]. */
void feasible_map_place(const feasible_map *m, int64_t node, int32_t at[SAMPLE_AXES_MAX]);
