/* face_compare: a predicted face against an actual one, region by region, beside the two trivial predictions. */
#pragma once
#include "app/planner/predict/outcome_read.h"
#include "geometry/face_regions.h"
#include "geometry/surface_compare.h"

typedef enum prediction_kind {
    PREDICTED,
    NO_CHANGE,     /* the skin before */
    SMOOTHED_BONE, /* the skin before, following the bone below it; see geometry/smoothed_motion.h */
    PREDICTION_COUNT
} prediction_kind;

const char *prediction_name(prediction_kind k);

typedef struct face_compare_input {
    const char *predicted, *actual;           /* an outcome folder or a mesh */
    const char *landmarks, *actual_landmarks; /* files; may be NULL for outcomes, which have their own */
    bool align;
} face_compare_input;

/* Rows of the tables: the regions of the face, then the lower face and the whole face. */
enum { ROW_LOWER = FACE_REGION_COUNT - 1, ROW_FACE, ROW_COUNT };
const char *face_row_name(int row);

typedef struct face_compare {
    surface skin[PREDICTION_COUNT];  /* NO_CHANGE and SMOOTHED_BONE only for outcomes; the same triangles */
    int predictions;                 /* 1, or PREDICTION_COUNT */
    landmarks points, actual_points; /* as predicted; actual, aligned (count 0: none) */
    landmarks rest_points;           /* before, same order as points (count 0: of a mesh, not known) */
    head_frame frame;
    face_map map;
    bool aligned;
    surface_fit fit;                     /* of the actual face */
    double turn_at_chin_mm;              /* what its turn alone moves the chin by; NaN: the skin has no chin */
    double *signed_mm[PREDICTION_COUNT]; /* [vertex_count] */
    distance_stats row[PREDICTION_COUNT][ROW_COUNT];
} face_compare;

/* Refuses what its readers, face_map_make, face_fit and surface_signed_distance refuse, a mesh without
 * landmarks and faces of which no point was compared. The caller frees *out. */
bool face_compare_make(const face_compare_input *in, face_compare *out, err *e) MUST_CHECK;
void face_compare_free(face_compare *c); /* idempotent */

/* Actual minus predicted for landmark i of `predicted` (points, or rest_points), in the frame of the head: forward, up,
 * left. False where the actual face has no such landmark. */
bool face_compare_landmark(const face_compare *c, const landmarks *predicted, int32_t i, double out[3]);
/* The prediction is closer than both trivial ones in this row, by the mean absolute distance. */
bool face_compare_beats(const face_compare *c, int row);
