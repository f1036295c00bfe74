/* repair: from a scanned surface to one that encloses a volume (CGAL PMP and alpha wrap, geometry/cgal). */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct repair_report { /* what was found and changed */
    int32_t welded_vertices, degenerate_triangles, duplicate_triangles;
    int32_t components_found, components_dropped;
    double dropped_area_mm2;
    int32_t boundary_loops, holes_filled;
    double widest_hole_mm;
    int32_t self_intersections_found, self_intersections_left;
    bool flipped, wrapped;   /* wrapped: replaced by a tight alpha wrap, the last resort */
    double max_deviation_mm; /* from the input's surface to the result, over input vertices that were kept */
    int32_t vertices_moved;  /* kept input vertices that are more than 0.1 mm away from the result: the defects */
} repair_report;

typedef struct repair_params {
    double min_component_share;           /* drop components with less than this share of the largest one's area */
    double wrap_alpha_mm, wrap_offset_mm; /* of the last resort */
} repair_params;

repair_params repair_params_default(void);

/* Welds, orients, fills every hole, removes self-intersections: *out is closed, outward and free of
 * self-intersection; sound parts do not move. The caller frees *out. Refuses (ERR_GEOMETRY) what cannot be
 * closed. report may be NULL. */
bool repair_solid(const surface *in, const repair_params *p, surface *out, repair_report *report, err *e) MUST_CHECK;

/* Number of intersecting triangle pairs, at most `limit`, of any surface that passes surface_check: crowded
 * edges and turned triangles do not matter. Triangles without area count too. */
bool repair_count_self_intersections(const surface *s, int32_t limit, int32_t *count, err *e) MUST_CHECK;

/* Alpha wrap: a closed surface around the (any quality) input, no ball of radius alpha fits into what it
 * fills; offset outwards by offset_mm. The caller frees *out. */
bool repair_wrap(const surface *in, double alpha_mm, double offset_mm, surface *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
