/* outcome_read: what later verbs need of an outcome folder. */
#pragma once
#include "geometry/frame.h"
#include "geometry/json_file.h"
#include "geometry/segments.h"

typedef struct outcome_record {
    json_file file;          /* outcome.json */
    landmarks before, after; /* same labels and order */
    head_frame frame;        /* of before */
} outcome_record;

bool is_outcome(const char *folder); /* it holds outcome.json */
/* Refuses (ERR_INPUT) what record_check refuses, an outcome without landmarks, and one whose solve did not reach
 * equilibrium. The caller frees *out. */
bool outcome_record_read(const char *folder, outcome_record *out, err *e) MUST_CHECK;
/* skin_before.ply or skin_after.ply. The caller frees *out. */
bool outcome_skin_read(const char *folder, bool after, surface *out, err *e) MUST_CHECK;
/* The segments at rest (the folder has them as planned) and their moves. The caller frees *at_rest. */
bool outcome_segments_read(const char *folder, const outcome_record *r, segments *at_rest, rigid move[SEGMENT_COUNT],
                           err *e) MUST_CHECK;
void outcome_record_free(outcome_record *r); /* idempotent */

typedef struct outcome_shapes { /* all that is drawn of an outcome */
    outcome_record record;
    surface skin_before, skin_after; /* of the same triangles */
    segments at_rest;
    rigid move[SEGMENT_COUNT];
} outcome_shapes;

/* Refuses what the readers above refuse and (ERR_INPUT) skins of different triangles. The caller frees *out. */
bool outcome_shapes_read(const char *folder, outcome_shapes *out, err *e) MUST_CHECK;
void outcome_shapes_free(outcome_shapes *s); /* idempotent */
