/* plan_file: one set of bone moves as described by a plan in JSON, checked against its case. Plain data. */
#pragma once
#include "app/planner/plan/controls.h"
#include "geometry/landmarks.h"

typedef struct plan_segment {
    int line;                        /* in the plan */
    bool short_form;                 /* named by its controls, whose values say the move; `move` is none then */
    segment_move move;               /* the long form: angles about a pivot, or a matrix */
    char pivot[LANDMARK_LABEL_SIZE]; /* landmark, or "" */
    bool has_pivot_point;            /* move.pivot_mm is set */
    char file[FIELD_PATH_SIZE];      /* .tfm, or "" */
} plan_segment;

typedef struct plan_file {
    char path[FIELD_PATH_SIZE];
    char name[FIELD_TEXT_SIZE];
    char override[FIELD_TEXT_SIZE]; /* why bounds may be left; "" if they may not */
    int version, load_steps;
    double value[CONTROL_COUNT]; /* of each control */
    plan_segment segment[SEGMENT_COUNT];
} plan_file;

plan_file plan_file_default(void);
/* Everything wrong becomes an issue; true if none of them is an error, and only then *out is complete.
 * Refuses a move of a segment that the case does not cut, two forms for one segment, and non-zero controls
 * that are not built. */
bool plan_file_read(const char *path, const case_file *c, plan_file *out, issue_list *issues) MUST_CHECK;

const field_table *plan_fields(void);
const field_table *plan_segment_fields(void); /* of each object in "segments" */
