/* A head of blocks, where every bound of a plan is known, and its judge. */
#pragma once
#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "app/planner/judge/judge.h"

static case_file patient;
static prepared head;
static judge *all;

/* Skull above, maxilla below it with half a millimetre of saw between, mandible 0.8 mm below the upper "teeth". The
 * mandible ends 10 mm behind the maxilla's front, so that a tilt is measured from below. */
static inline int make_head(void **state)
{
    (void)state;
    err e = {0};
    const struct {
        const char *label;
        double x[3];
    } points[] = {{"Po_L", {60, 10, 30}},      {"Po_R", {-60, 10, 30}},   {"Or_L", {30, -80, 30}},
                  {"Or_R", {-30, -80, 30}},    {"N", {0, -90, 40}},       {"U1", {0, -90, -20}},
                  {"U6_L", {20, -50, -20}},    {"U6_R", {-20, -50, -20}}, {"U3_L", {15, -80, -20}},
                  {"U3_R", {-15, -80, -20}},   {"L1", {0, -80, -20.8}},   {"L6_L", {20, -50, -20.8}},
                  {"L6_R", {-20, -50, -20.8}}, {"PR_L", {12, -88, 0}},    {"PR_R", {-12, -88, 0}},
                  {"ZB_L", {28, -60, 0}},      {"ZB_R", {-28, -60, 0}},   {"Me", {0, -80, -60}}};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        landmarks_set(&head.points, points[i].label, points[i].x);
    patient = case_file_default();
    assert_ok(head_frame_from_landmarks(&head.points, &head.frame, &e));
    head.segments.part[SEGMENT_CRANIUM] = body_box(-30, -90, 0.25, 30, -20, 40);
    head.segments.part[SEGMENT_MAXILLA] = body_box(-30, -90, -20, 30, -20, -0.25);
    head.segments.part[SEGMENT_DISTAL] = body_box(-30, -80, -60, 30, -20, -20.8);
    head.segments.kerf = body_box(-30, -90, -0.25, 30, -20, 0.25);
    assert_ok(judge_create(&patient, &head, &all, &e));
    return 0;
}

static inline int drop_head(void **state)
{
    (void)state;
    judge_free(&all);
    segments_free(&head.segments);
    landmarks_free(&head.points);
    return 0;
}

static inline plan_file still(void)
{
    plan_file p = plan_file_default();
    p.segment[SEGMENT_MAXILLA].move.kind = p.segment[SEGMENT_DISTAL].move.kind = MOVE_ANGLES;
    return p;
}

static inline void judged(const plan_file *p, judgement *out)
{
    plan_moves m;
    issue_list issues = {0};
    assert_true(plan_moves_set(p, &patient, &head.points, &m, &issues));
    issue_list_free(&issues);
    judge_plan(all, &m, out);
}

static inline const finding *find(const judgement *j, limit_id id)
{
    for (int i = 0; i < j->count; i++)
        if (j->finding[i].limit == id) return &j->finding[i];
    fail();
    return NULL;
}
