/* control: one number of a plan that an audit varies: a direction or an axis of the head's frame for one segment. */
#pragma once
#include "app/planner/plan/plan_file.h"
#include "geometry/frame.h"

typedef enum control_part {
    CONTROL_FORWARD,
    CONTROL_UP,
    CONTROL_LEFT,
    CONTROL_PITCH,
    CONTROL_YAW,
    CONTROL_ROLL,
    CONTROL_PART_COUNT
} control_part;

typedef struct control {
    char name[40];    /* "maxilla_advance_mm", "mandible_yaw_deg" */
    const char *unit; /* "mm" or "deg" */
    segment_id segment;
    control_part part;
    limit_id limit; /* of the moves, whose stop range is the box */
    double low, high;
} control;

/* PIECE_advance_mm, _lift_mm (of the maxilla _impaction_mm), _lateral_mm, _pitch_deg, _yaw_deg, _roll_deg for the
 * pieces maxilla, mandible, chin, proximal_left and proximal_right. Refuses (ERR_USAGE) another name, with the nearest
 * one; (ERR_INPUT) a piece that the case does not cut. */
bool control_find(const char *name, const case_file *c, control *out, err *e) MUST_CHECK;

/* Writes the short form of every segment as a long one, so that controls can be set. Refuses (ERR_INPUT) a plan that
 * moves the control's segment by a matrix. */
bool control_open_plan(const control *x, const head_frame *f, plan_file *p, err *e) MUST_CHECK;
double control_value(const control *x, const head_frame *f, const plan_file *p);
/* The control only; the plan was opened for it. */
void control_set(const control *x, const head_frame *f, double value, plan_file *p);
