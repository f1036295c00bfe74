/* movements: the table of moves that planners read, one row for each segment that moves. */
#pragma once
#include "app/planner/store/record.h"
#include "geometry/landmarks.h"
#include "geometry/rig.h"

typedef struct movement {
    segment_id segment;
    const char *at;                      /* the landmark whose path is given, see plan_moves_reference; NULL: none */
    double left_mm, anterior_mm, up_mm;  /* along the head's own axes; NaN where there is no landmark */
    double pitch_deg, yaw_deg, roll_deg; /* with the signs of geometry/rig.h */
} movement;

/* Fills out[], which points into `before`; returns how many segments move. The chin's move holds the distal
 * segment's. */
int movements_make(const rigid move[SEGMENT_COUNT], const landmarks *before, const head_frame *frame,
                   movement out[SEGMENT_COUNT]);
extern const record_table movement_table;
