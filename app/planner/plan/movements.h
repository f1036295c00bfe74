/* movements: the table of moves that planners read, one row for each segment that moves. */
#pragma once
#include "geometry/json_file.h"
#include "geometry/rig.h"

/* A list of objects: segment, at (the landmark whose path is given, see plan_moves_reference), left_mm, anterior_mm,
 * up_mm along the head's own axes, pitch_deg, yaw_deg, roll_deg with the signs of geometry/rig.h. The chin's move
 * holds the distal segment's. Without a landmark on the segment, `at` and the lengths are null. */
json_t *movements_json(const rigid move[SEGMENT_COUNT], const landmarks *before, const head_frame *frame);
