/* point_rules: what a landmark's definition asks of a surface near by: the farthest point in a direction, of a side
 * that faces it or looks away from it. */
#pragma once
#include "app/planner/patient/case_file.h"

typedef struct point_rule {
    const char *label; /* with both: without _L and _R */
    bool both;
    case_surface on;      /* CASE_SURFACE_COUNT: inside, moved by its anchor alone */
    double direction[3];  /* outwards on the point's own side (left for _L), posterior, up; zero: the nearest point */
    const char *chord[2]; /* where named, upper and lower: the direction is into the head, across their chord */
    int facing;           /* 1: the surface faces the direction (a tip, an edge), -1: away (a fold, a roof), 0: any */
    double reach_mm;      /* from the carried place */
    double pull[3];       /* 1/mm, same axes: a place d mm from the carried one must gain pull d^2 / 2 mm */
    const char *anchor;   /* a label of the same side that knows more of the place than what was carried */
    unsigned axes; /* in these axes (bits 1, 2, 4) the place is `offset` from the anchor; 0: it moves along with it */
    double offset[3];
    bool turns;        /* the direction turns with a mandible that stands steeper or flatter than usual */
    const char *below; /* a label that it cannot lie above, or NULL */
    bool row_ends;     /* the last molar, where teeth and bone are one: the row goes on as far as the ramus begins */
    bool occlusal;     /* in an open mouth its height is that of the lower row of teeth */
    double doubt_mm;   /* of the definition itself, where heads or readers differ */
    bool saddle;       /* the least far of the farthest points across, along saddle_axis */
    int saddle_axis;
} point_rule;

enum { POINT_RULES_OF_FRAME = 1 };     /* Or, the first one: it and Po tell the Frankfort plane */
extern const point_rule point_rules[]; /* in an order in which chords and anchors come before what hangs on them */
extern const int point_rule_count;
/* side: 1 left, -1 right, 0 middle. NULL: the label has none and goes to the nearest place of its surface. */
const point_rule *point_rule_find(const char *label, int *side);
