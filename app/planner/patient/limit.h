/* limit: the numbers a plan is judged by. Each has a range in which it is fine and a wider one beyond which the plan
 * has to say why ("override"); between the two lies caution. An open end is infinite. */
#pragma once
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#define LIMIT_OPEN ((double)HUGE_VAL) /* no end on that side */

/* X(ENUMERATOR, name, unit, fine low, fine high, stop low, stop high, what, source).
 *
 * Moves: advance is forwards, impaction and lift upwards (a shortening of the chin), lateral to the patient's left,
 * turn the angle of the rotation. Maxilla: upper incisal edge; mandible: the distal segment at the lower incisal edge;
 * chin: relative to the distal segment, at pogonion; condyle: proximal segments, at condylion. */
#define LIMITS_OF_MOVES(X)                                                                                             \
    X(MAXILLA_ADVANCE, maxilla_advance_mm, "mm", -3, 6, -5, 8, "maxilla forwards",                                     \
      "above 6 mm a bone graft, above 8 mm distraction is usual, above 10 mm blood supply is at risk (Peterson's "     \
      "Principles 2022, ch. 63 and 68); setback above 5 mm is done in pieces")                                         \
    X(MAXILLA_IMPACTION, maxilla_impaction_mm, "mm", -2, 5, -5, 10, "maxilla upwards",                                 \
      "downwards, a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28); "   \
      "upwards: clinical custom")                                                                                      \
    X(MAXILLA_LATERAL, maxilla_lateral_mm, "mm", -4, 4, -6, 6, "maxilla to the left",                                  \
      "own limit, no published number; more is usually a slip")                                                        \
    X(MAXILLA_TURN, maxilla_turn_deg, "deg", 0, 8, 0, 15, "rotation of the maxilla",                                   \
      "own limit, no published number; more is usually a slip")                                                        \
    X(MANDIBLE_ADVANCE, mandible_advance_mm, "mm", -8, 7, -10, 12, "mandible forwards",                                \
      "setback above 10 mm narrows the airway, advancement above 7 mm needs more fixation, above 12 mm distraction "   \
      "or another cut (Peterson's Principles 2022, ch. 62 and 68; Atlas of Operative Oral and Maxillofacial Surgery "  \
      "2023, ch. 28)")                                                                                                 \
    X(MANDIBLE_LIFT, mandible_lift_mm, "mm", -5, 8, -10, 15, "mandible upwards",                                       \
      "envelope of discrepancy (Proffit, Contemporary Orthodontics)")                                                  \
    X(MANDIBLE_LATERAL, mandible_lateral_mm, "mm", -6, 6, -10, 10, "mandible to the left",                             \
      "own limit, no published number; more is usually a slip")                                                        \
    X(MANDIBLE_TURN, mandible_turn_deg, "deg", 0, 8, 0, 15, "rotation of the mandible",                                \
      "own limit, no published number; more is usually a slip")                                                        \
    X(CHIN_ADVANCE, chin_advance_mm, "mm", -4, 6, -5, 10, "chin forwards",                                             \
      "beyond it a second step or a graft is needed (Peterson's Principles 2022, ch. 62; clinical custom)")            \
    X(CHIN_LIFT, chin_lift_mm, "mm", -4, 4, -5, 5, "chin upwards",                                                     \
      "a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28); upwards: "     \
      "clinical custom")                                                                                               \
    X(CHIN_LATERAL, chin_lateral_mm, "mm", -6, 6, -10, 10, "chin to the left",                                         \
      "own limit, no published number; more is usually a slip")                                                        \
    X(CHIN_TURN, chin_turn_deg, "deg", 0, 8, 0, 15, "rotation of the chin",                                            \
      "own limit, no published number; more is usually a slip")                                                        \
    X(CONDYLE_SHIFT, condyle_shift_mm, "mm", 0, 1, 0, 2, "shift of a condyle",                                         \
      "a displaced condyle predicts relapse (Peterson's Principles 2022, ch. 62 and 68); 2 mm is clinical custom")     \
    X(CONDYLE_TURN, condyle_turn_deg, "deg", 0, 2, 0, 5, "turn of a proximal segment",                                 \
      "a displaced condyle predicts relapse (Peterson's Principles 2022, ch. 62 and 68); 5 degrees is clinical "       \
      "custom")

/* Of the jaws as planned. Gaps and depths of overlap count the saw's width as bone that is gone. */
#define LIMITS_OF_BONE(X)                                                                                              \
    X(AIRWAY_SETBACK, airway_setback_mm, "mm", -LIMIT_OPEN, 7, -LIMIT_OPEN, 10, "setback of both jaws' bite",          \
      "after a setback of 8 mm the airway keeps 81 % of its volume at one year, above 10 mm a third got sleep "        \
      "apnoea (Maxillofac. Plast. Reconstr. Surg. 2020, 42); the scan's airway itself is not measured")                \
    X(LE_FORT_GAP, le_fort_gap_mm, "mm", -LIMIT_OPEN, 3, -LIMIT_OPEN, 5, "opening of the Le Fort I cut",               \
      "a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28)")               \
    X(LE_FORT_STEP, le_fort_step_mm, "mm", 0, 6, 0, 10, "step of the bone at the Le Fort I cut",                       \
      "a bone graft is usual above 6 mm (Peterson's Principles 2022, ch. 63); 10 mm: own limit")                       \
    X(LE_FORT_CONTACT, le_fort_contact_mm2, "mm2", 50, LIMIT_OPEN, -LIMIT_OPEN, LIMIT_OPEN,                            \
      "bone with bone within 1.5 mm and the saw at the Le Fort I cut",                                                 \
      "own limit, no published number; plates and grafts bridge it")                                                   \
    X(BSSO_GAP, bsso_gap_mm, "mm", -LIMIT_OPEN, 3, -LIMIT_OPEN, 5, "opening between the plates of the split",          \
      "a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28)")               \
    X(BSSO_BUCCAL_GAP, bsso_buccal_gap_mm, "mm", -LIMIT_OPEN, 8, -LIMIT_OPEN, 13, "opening of the buccal cut",         \
      "it opens by the advancement, for which see mandible_advance_mm, and the saw's width")                           \
    X(BSSO_STEP, bsso_step_mm, "mm", 0, 4, 0, 10, "step of the jaw's border at the buccal cut",                        \
      "own limit, no published number; a notch that is felt")                                                          \
    X(BSSO_CONTACT, bsso_contact_mm2, "mm2", 200, LIMIT_OPEN, -LIMIT_OPEN, LIMIT_OPEN,                                 \
      "bone with bone within 1.5 mm and the saw in a split", "own limit, no published number; room for three screws")  \
    X(CHIN_GAP, chin_gap_mm, "mm", -LIMIT_OPEN, 3, -LIMIT_OPEN, 5, "opening of the chin cut",                          \
      "a gap above 5 mm needs a graft (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28)")               \
    X(CHIN_STEP, chin_step_mm, "mm", 0, 6, 0, 10, "step of the bone at the chin cut",                                  \
      "more than the symphysis is thick needs two steps (Peterson's Principles 2022, ch. 62); clinical custom")        \
    X(CHIN_CONTACT, chin_contact_mm2, "mm2", 100, LIMIT_OPEN, 30, LIMIT_OPEN,                                          \
      "bone with bone within 1.5 mm and the saw at the chin cut", "own limit, no published number")                    \
    X(NERVE_ROOM, nerve_room_mm, "mm", 1, LIMIT_OPEN, 0.2, LIMIT_OPEN, "mandibular canal to the proximal segment",     \
      "own limit, no published number; the course of the canal is estimated")                                          \
    X(TRIM_DEPTH, trim_depth_mm, "mm", 0, 1, 0, 10, "bone to be trimmed beside a cut, depth",                          \
      "up to 1 mm the saw takes; an impaction or setback by as much is planned with a strip of bone removed "          \
      "(Peterson's Principles 2022, ch. 62); 10 mm is the limit of those moves")                                       \
    X(TRIM_VOLUME, trim_volume_mm3, "mm3", 0, 500, -LIMIT_OPEN, LIMIT_OPEN, "bone to be trimmed beside a cut",         \
      "own limit, no published number")                                                                                \
    X(INTERFERENCE, interference_mm, "mm", 0, 1, 0, 3, "bones in each other's way away from a cut, depth",             \
      "own limit, no published number")                                                                                \
    X(TOOTH_OVERLAP, tooth_overlap_mm, "mm", -LIMIT_OPEN, 1, -LIMIT_OPEN, 3,                                           \
      "teeth in each other, depth (negative: apart)",                                                                  \
      "own limit, no published number; 1 mm is the noise of a scan's crowns")

/* Of the bite and the face's symmetry; goals more than limits, so that few of them stop. */
#define LIMITS_OF_BITE(X)                                                                                              \
    X(OVERJET, overjet_mm, "mm", 1, 5, -10, 10, "overjet",                                                             \
      "norm 3.2, sd 0.6 mm (Arnett 1999); beyond 10 mm either way no plan ends: own limit")                            \
    X(OVERBITE, overbite_mm, "mm", 0, 5, -LIMIT_OPEN, LIMIT_OPEN, "overbite", "norm 3.2, sd 0.7 mm (Arnett 1999)")     \
    X(OPEN_BITE, open_bite_mm, "mm", -LIMIT_OPEN, 0, -LIMIT_OPEN, 20, "open bite",                                     \
      "above 20 mm both jaws must be cut (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 28)")            \
    X(BITE_CONTACTS, bite_contacts, "", 3, LIMIT_OPEN, -LIMIT_OPEN, LIMIT_OPEN, "places where the teeth meet",         \
      "three carry a bite; own limit")                                                                                 \
    X(DENTAL_MIDLINE, dental_midline_mm, "mm", -2, 2, -LIMIT_OPEN, LIMIT_OPEN, "lower midline left of the upper",      \
      "2 mm is seen (own limit after the chin's)")                                                                     \
    X(UPPER_MIDLINE, upper_midline_mm, "mm", -2, 2, -LIMIT_OPEN, LIMIT_OPEN, "upper midline left of the face's",       \
      "2 mm is seen (own limit after the chin's)")                                                                     \
    X(CHIN_DEVIATION, chin_deviation_mm, "mm", -2, 2, -LIMIT_OPEN, LIMIT_OPEN, "chin left of the face's midline",      \
      "specialists see 2 mm, others 4 mm (Int. J. Dent. 2021, 8946063)")                                               \
    X(CANINE_YAW, canine_yaw_mm, "mm", -2, 2, -LIMIT_OPEN, LIMIT_OPEN, "right upper canine before the left",           \
      "up to 2 mm of yaw may be left (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 26)")                \
    X(OCCLUSAL_PLANE, occlusal_plane_deg, "deg", 4, 12, -LIMIT_OPEN, LIMIT_OPEN, "occlusal plane, front down",         \
      "8, sd 4 degrees to the Frankfort plane (Peterson's Principles 2022, ch. 60)")                                   \
    X(OCCLUSAL_CANT, occlusal_cant_deg, "deg", -2, 2, -LIMIT_OPEN, LIMIT_OPEN, "occlusal plane, left side down",       \
      "own limit, no published number; 2 degrees are 1.7 mm between the first molars")

/* Of the case and its cuts: no plan changes them. */
#define LIMITS_OF_CUTS(X)                                                                                              \
    X(ROOT_CLEARANCE, root_clearance_mm, "mm", 5, LIMIT_OPEN, 1, LIMIT_OPEN, "cut to a root tip, bone for the screws", \
      "5 mm (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 27 and 30); below 1 mm: own limit")           \
    X(FORAMEN_CLEARANCE, foramen_clearance_mm, "mm", 5, LIMIT_OPEN, 1, LIMIT_OPEN,                                     \
      "cut to the mental or infraorbital foramen",                                                                     \
      "5 mm (Atlas of Operative Oral and Maxillofacial Surgery 2023, ch. 30; Peterson's Principles 2022, ch. 62)")     \
    X(NERVE_CLEARANCE, nerve_clearance_mm, "mm", 1, LIMIT_OPEN, 0, LIMIT_OPEN, "cut to the mandibular canal",          \
      "own limit, no published number")                                                                                \
    X(CHIN_HEIGHT, chin_height_mm, "mm", 10, LIMIT_OPEN, -LIMIT_OPEN, LIMIT_OPEN,                                      \
      "height of the chin piece, for the plate", "clinical custom")                                                    \
    X(CUT_MARGIN, cut_margin_mm, "mm", 0, LIMIT_OPEN, -LIMIT_OPEN, LIMIT_OPEN, "other margins of the cuts",            \
      "the case's \"cuts\"")                                                                                           \
    X(CASE_WARNINGS, case_warnings, "", 0, 0, -LIMIT_OPEN, LIMIT_OPEN, "something doubtful about the case",            \
      "gnathos check and the cuts warn of it")

/* Of the predicted face: known after the solve. */
#define LIMITS_OF_TISSUE(X)                                                                                            \
    X(SOLVED, solved, "", 1, LIMIT_OPEN, 1, LIMIT_OPEN, "the soft tissue finds its balance", "own limit")              \
    X(SMALLEST_J, smallest_j, "", 0.1, LIMIT_OPEN, 0, LIMIT_OPEN, "smallest volume ratio of a tetrahedron",            \
      "below 0 a tetrahedron is turned inside out")                                                                    \
    X(STRETCH, largest_stretch, "", 0, 3, -LIMIT_OPEN, LIMIT_OPEN, "largest stretch of the tissue",                    \
      "own limit: the elastic law is not measured beyond")                                                             \
    X(INCISOR_SHOW, incisor_show_mm, "mm", 2, 6, -LIMIT_OPEN, LIMIT_OPEN, "upper incisor below the lip, at rest",      \
      "men 2 to 4, women 3 to 6 mm (Peterson's Principles 2022, ch. 59)")                                              \
    X(LOWER_FACE, lower_face_share, "", 0.48, 0.54, -LIMIT_OPEN, LIMIT_OPEN, "lower share of the face's height",       \
      "specialists see 48 and 54 %, others 46 and 56 % (Int. J. Dent. 2021, 8946063)")

#define LIMITS(X) LIMITS_OF_MOVES(X) LIMITS_OF_BONE(X) LIMITS_OF_BITE(X) LIMITS_OF_CUTS(X) LIMITS_OF_TISSUE(X)

typedef enum limit_id {
#define X(id, ...) LIMIT_##id,
    LIMITS(X)
#undef X
        LIMIT_COUNT,
    LIMIT_MOVE_COUNT = LIMIT_AIRWAY_SETBACK /* the first ones come from the moves alone */
} limit_id;

typedef enum limit_level { LIMIT_NOT_JUDGED, LIMIT_FINE, LIMIT_CAUTION, LIMIT_STOP } limit_level;

typedef struct limit_range {
    double fine[2], stop[2];
} limit_range;

typedef struct limit {
    const char *name; /* "maxilla_advance_mm" */
    const char *unit, *what, *source;
    limit_range range;
} limit;

extern const limit limit_default[LIMIT_COUNT];

/* Rounding of rotations and frames is not a breach. */
limit_level limit_judge(const limit_range *r, double value);
/* To the nearer end of the stop range, positive inside; infinite where it has no end. Two ranges that both begin at 0
 * are of something that is never negative: that end does not count. */
double limit_margin(const limit_range *r, double value);
const char *limit_level_name(limit_level level); /* "not judged", "fine", "caution", "stop" */
enum { LIMIT_WORDS_SIZE = 48 };
/* "3 to 6", "at least 5", "at most 3", "-". */
const char *limit_range_words(const double r[2], char text[LIMIT_WORDS_SIZE]);
