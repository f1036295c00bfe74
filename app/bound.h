/* bound: how far a plan may move each piece of bone before it has to say why. */
#pragma once
#include <stddef.h>

/* X(ENUMERATOR, field, low, high, source) in the units of the field's name. Advance is forwards, lift upwards
 * (an impaction of the maxilla, a shortening of the chin), lateral to the patient's left, turn the angle of
 * the rotation. Maxilla: upper incisal edge; mandible: the distal segment at the lower incisal edge; chin:
 * relative to the distal segment, at pogonion; condyle: proximal segments, at condylion. */
#define BOUNDS(X)                                                                                            \
    X(MAXILLA_ADVANCE, maxilla_advance_mm, -5, 10,                                                           \
      "above 8 mm distraction is usual, above 10 mm blood supply is at risk (Peterson's Principles 2022, "   \
      "ch. 63 and 68); "                                                                                     \
      "setback above 5 mm is done in pieces")                                                                \
    X(MAXILLA_IMPACTION, maxilla_impaction_mm, -5, 10,                                                       \
      "a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28); "    \
      "upwards: clinical custom")                                                                            \
    X(MAXILLA_LATERAL, maxilla_lateral_mm, -6, 6, "own limit, no published number; more is usually a slip")  \
    X(MAXILLA_TURN, maxilla_turn_deg, 0, 15, "own limit, no published number; more is usually a slip")       \
    X(MANDIBLE_ADVANCE, mandible_advance_mm, -10, 12,                                                        \
      "setback above 10 mm narrows the airway, advancement above 12 mm needs distraction or another cut "    \
      "(Peterson's Principles 2022, ch. 62 and 68)")                                                         \
    X(MANDIBLE_LIFT, mandible_lift_mm, -10, 15,                                                              \
      "envelope of discrepancy (Proffit, Contemporary Orthodontics)")                                        \
    X(MANDIBLE_LATERAL, mandible_lateral_mm, -10, 10,                                                        \
      "own limit, no published number; more is usually a slip")                                              \
    X(MANDIBLE_TURN, mandible_turn_deg, 0, 15, "own limit, no published number; more is usually a slip")     \
    X(CHIN_ADVANCE, chin_advance_mm, -5, 10,                                                                 \
      "beyond it a second step or a graft is needed (Peterson's Principles 2022, ch. 62; clinical custom)")  \
    X(CHIN_LIFT, chin_lift_mm, -5, 5,                                                                        \
      "a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28); "    \
      "upwards: clinical custom")                                                                            \
    X(CHIN_LATERAL, chin_lateral_mm, -10, 10, "own limit, no published number; more is usually a slip")      \
    X(CHIN_TURN, chin_turn_deg, 0, 15, "own limit, no published number; more is usually a slip")             \
    X(CONDYLE_SHIFT, condyle_shift_mm, 0, 2,                                                                 \
      "a displaced condyle predicts relapse (Peterson's Principles 2022, ch. 62 and 68); 2 mm is clinical "  \
      "custom")                                                                                              \
    X(CONDYLE_TURN, condyle_turn_deg, 0, 5,                                                                  \
      "a displaced condyle predicts relapse (Peterson's Principles 2022, ch. 62 and 68); 5 degrees is "      \
      "clinical custom")

typedef enum bound_id {
#define X(id, field, low, high, source) BOUND_##id,
    BOUNDS(X)
#undef X
        BOUND_COUNT
} bound_id;

typedef struct bound {
    const char *name; /* "maxilla_advance_mm" */
    double low, high;
    const char *source;
} bound;

extern const bound bound_default[BOUND_COUNT];
