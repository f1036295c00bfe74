/* cutter: the closed bodies that osteotomies are made with. */
#pragma once
#include "geometry/frame.h"
#include "geometry/surface.h"

typedef struct cutter {
    surface body;   /* closed, outward */
    uint8_t *moves; /* [body.triangle_count] the triangle is part of the saw cut */
} cutter;

void cutter_free(cutter *c);

/* Polygons of `nodes` corners stacked in `levels` layers, xyz[3*(level*nodes + node)]. Side j runs from node
 * j to j + 1; side_moves[nodes]. The first and last polygon are the caps, triangulated as seen along their
 * mean normal: they must be simple polygons there. */
cutter cutter_stack(int levels, int nodes, const double *xyz, const uint8_t *side_moves, bool first_cap_moves,
                    bool last_cap_moves);
/* A box in the axes of f. */
cutter cutter_box(const head_frame *f, const double low[3], const double high[3]);
/* The body with its moving faces shifted outwards by moving_mm and the others by fixed_mm. */
surface cutter_offset(const cutter *c, double moving_mm, double fixed_mm);
/* The moving faces only. */
surface cutter_sheet(const cutter *c);
