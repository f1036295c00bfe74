/* plan_moves: from the words of a plan to rigid moves, and how they stand to the limits of moves. */
#pragma once
#include "app/planner/plan/plan_file.h"

typedef struct plan_moves {
    rigid move[SEGMENT_COUNT]; /* of each segment, LPS mm; the chin's includes the distal segment's */
    double measure[LIMIT_MOVE_COUNT];
    double commanded_turn_deg; /* the larger turn of the proximal segments that the plan gives by angles; 0: none. A
                                  matrix or a file is what a registration measured */
} plan_moves;

/* The moves are those of geometry/rig.h: advance and impaction along the head's Frankfort frame, angles about its axes,
 * translate_mm, matrices and .tfm files in file axes (LPS). A rotation without a pivot turns about the segment's point:
 * upper incisor, lower incisor, pogonion or condylion. The chin's own move is relative to the distal segment.
 *
 * Missing landmarks are errors. True if there is no error, and only then *out is written; limits are not asked. */
bool plan_moves_set(const plan_file *p, const case_file *c, const landmarks *l, plan_moves *out,
                    issue_list *issues) MUST_CHECK;
/* The same, and a move beyond its limit's stop range is an error (ERR_INFEASIBLE) with its source, a warning if the
 * plan has an override. */
bool plan_moves_make(const plan_file *p, const case_file *c, const landmarks *l, plan_moves *out,
                     issue_list *issues) MUST_CHECK;
/* Where the move of a segment is measured, and about what it turns where a plan names no pivot: upper incisor, lower
 * incisor, pogonion, condylion, or a neighbour of theirs; NULL if the case has none. */
const landmark *plan_moves_reference(const landmarks *l, segment_id s);
/* Left and right condyle; false if the case has not both. */
bool plan_moves_condyles(const landmarks *l, double condyle[2][3]) MUST_CHECK;
/* Case, landmarks and plan in one call, for verbs that need no more than the first error. */
bool plan_moves_load(const char *plan_path, const case_file *c, const landmarks *l, plan_file *plan, plan_moves *out,
                     err *e) MUST_CHECK;
