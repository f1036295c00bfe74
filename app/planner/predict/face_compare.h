/* face_compare: a predicted face against an actual one, region by region, beside the two trivial predictions. */
#pragma once
#include "app/planner/predict/outcome_read.h"
#include "geometry/face_regions.h"
#include "geometry/surface_compare.h"

typedef enum prediction_kind {
    PREDICTED,
    NO_CHANGE,     /* the skin before */
    SMOOTHED_BONE, /* the skin before, following the bones' own moves below it; see geometry/smoothed_motion.h */
    PREDICTION_COUNT
} prediction_kind;

const char *prediction_name(prediction_kind k);

typedef enum compare_align {
    ALIGN_USUAL, /* on bone where both faces have it, on skin else */
    ALIGN_BONE,  /* on the front of the cranium; outcomes of one case lie in one place already */
    ALIGN_SKIN,  /* on the skin that no operation of the jaws moves (face_regions.h) */
    ALIGN_NONE   /* as they lie: both were registered on the cranium before */
} compare_align;

typedef struct face_compare_input {
    const char *predicted, *actual;           /* an outcome folder or a mesh */
    const char *landmarks, *actual_landmarks; /* files; may be NULL for outcomes, which have their own */
    const char *actual_skull;                 /* a mesh in the actual face's place; NULL: none, or the outcome's own */
    compare_align align;
} face_compare_input;

/* Rows of the tables: the regions of the face, then the lower face and the whole face. */
enum { ROW_LOWER = FACE_REGION_COUNT - 1, ROW_FACE, ROW_COUNT };
const char *face_row_name(int row);

typedef struct face_alignment { /* of the actual face */
    bool known;
    surface_fit fit;
    double turn_at_chin_mm; /* what the turn alone moves the chin by; NaN: the skin has no chin */
    double chin_mm;         /* and the whole move */
} face_alignment;

typedef struct face_compare {
    surface skin[PREDICTION_COUNT];  /* NO_CHANGE and SMOOTHED_BONE only for outcomes; the same triangles */
    int predictions;                 /* 1, or PREDICTION_COUNT */
    landmarks points, actual_points; /* as predicted; actual, aligned (count 0: none) */
    /* before, and those of the skin as SMOOTHED_BONE has them, bone's before; same order as points (count 0: of a mesh,
     * not known) */
    landmarks rest_points, smoothed_points;
    head_frame frame;
    face_map map;
    surface cranium, actual_cranium;     /* no vertices: not known */
    char case_hash[96];                  /* of a predicted outcome */
    bool one_case;                       /* both are outcomes of one case */
    compare_align on;                    /* what was done: never ALIGN_USUAL */
    face_alignment aligned;              /* not of ALIGN_NONE */
    face_alignment by_skin;              /* not of ALIGN_SKIN: what skin alone would move besides; NONE: if it fits */
    double *signed_mm[PREDICTION_COUNT]; /* [vertex_count] */
    distance_stats row[PREDICTION_COUNT][ROW_COUNT];
} face_compare;

/* Refuses what its readers, face_map_make, face_fit, surface_fit_rigid and surface_signed_distance refuse, a mesh
 * without landmarks, alignment on bone that is not known, crania that do not fit (more than 2 mm RMS) and faces of
 * which no point was compared. The caller frees *out. */
bool face_compare_make(const face_compare_input *in, face_compare *out, err *e) MUST_CHECK;
void face_compare_free(face_compare *c); /* idempotent */
/* A part of face_compare_make: moves actual, c->actual_points and c->actual_cranium. */
bool face_compare_align(compare_align how, face_compare *c, surface *actual, err *e) MUST_CHECK;

/* Actual minus predicted for landmark i of `predicted` (points, or rest_points), in the frame of the head: forward, up,
 * left. False where the actual face has no such landmark. */
bool face_compare_landmark(const face_compare *c, const landmarks *predicted, int32_t i, double out[3]);
/* The landmark lies on skin, which the trivial predictions are of. */
bool face_compare_on_skin(const char *label);
/* What decided where the actual face lies, in words. */
const char *face_compare_aligned_on(const face_compare *c);
/* The prediction is closer than both trivial ones in this row, by the mean absolute distance. */
bool face_compare_beats(const face_compare *c, int row);
