/* outcome_read: what later verbs need of an outcome folder. */
#pragma once
#include "geometry/frame.h"
#include "geometry/json_file.h"

typedef struct outcome_record {
    json_file file;            /* outcome.json */
    landmarks before, after;   /* same labels and order */
    head_frame frame;          /* of before */
} outcome_record;

bool is_outcome(const char *folder); /* it holds outcome.json */
/* Refuses (ERR_INPUT) what is not an outcome with landmarks, and one whose solve did not reach equilibrium. The
 * caller frees *out. */
bool outcome_record_read(const char *folder, outcome_record *out, err *e) MUST_CHECK;
void outcome_record_free(outcome_record *r); /* idempotent */
