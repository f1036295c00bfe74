/* point_refine: landmarks that a fitted template carried to about their places, moved to where the patient's own
 * surface has what their definitions ask for, in the patient's Frankfort frame. */
#pragma once
#include "app/planner/identity/head_scan.h"

typedef struct point_place {
    double at[3];
    double doubt_mm;     /* of the definition itself */
    bool by_rule, found; /* by_rule: has a definition on a surface; found: and that was there */
    double moved_mm;     /* from where it was carried */
    double spread_mm;    /* root mean square, over carried places that are 2 mm off in each direction */
} point_place;

/* out[carried->count], in the order of the carried ones. Points without a rule, on parts that the scan lacks or of the
 * inside stay where they are. Refuses what head_frame_from_landmarks refuses of the carried points. */
bool point_refine(const head_scan *s, const landmarks *carried, point_place *out, err *e) MUST_CHECK;
