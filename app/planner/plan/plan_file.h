/* plan_file: one set of bone moves as described by a plan in JSON, checked against its case. Plain data. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "geometry/landmarks.h"
#include "geometry/rigid.h"

typedef enum plan_form {
    FORM_NONE,   /* the segment is not named */
    FORM_SHORT,  /* advance and impaction */
    FORM_ANGLES, /* translate_mm and angles about a pivot */
    FORM_MATRIX  /* a matrix, in the plan or in a .tfm file */
} plan_form;

typedef struct plan_segment {
    plan_form form;
    int line; /* in the plan */
    double translate_mm[3], pitch_deg, yaw_deg, roll_deg;
    char pivot[LANDMARK_LABEL_SIZE]; /* landmark, or "" */
    bool has_pivot_point;
    double pivot_mm[3];
    char file[FIELD_PATH_SIZE]; /* .tfm, or "" */
    rigid motion;               /* of FORM_MATRIX */
} plan_segment;

typedef struct plan_jaw {
    double pitch_deg, yaw_deg, roll_deg, protrude_mm;
} plan_jaw;

typedef struct plan_file {
    char path[FIELD_PATH_SIZE];
    char name[FIELD_TEXT_SIZE];
    char override[FIELD_TEXT_SIZE]; /* why bounds may be left; "" if they may not */
    int version, load_steps;
    double maxilla_advance_mm, maxilla_impaction_mm, mandible_advance_mm, chin_advance_mm, rest;
    plan_jaw jaw;
    plan_segment segment[SEGMENT_COUNT];
} plan_file;

plan_file plan_file_default(void);
/* Everything wrong becomes an issue; true if none of them is an error, and only then *out is complete.
 * Refuses a move of a segment that the case does not cut, two forms for one segment, and non-zero controls
 * that are not built. */
bool plan_file_read(const char *path, const case_file *c, plan_file *out, issue_list *issues) MUST_CHECK;

const field_table *plan_fields(void);
const field_table *plan_segment_fields(void); /* of each object in "segments" */
