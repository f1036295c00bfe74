/* rig: from the controls of a plan to one rigid motion per bone segment.
 *
 * Rotations turn about the head's own axes (frame.h): left, posterior, up. By the right-hand rule, so
 *   pitch > 0  turns the front down  (about left; opens the jaw)
 *   yaw   > 0  turns the front to the patient's left (about up)
 *   roll  > 0  turns the left side down (about posterior)
 * applied in the order pitch, roll, yaw about one pivot, all three axes fixed to the head; translation comes
 * after. Degrees and mm: this is where the plan's numbers end. Bounds are checked elsewhere. */
#pragma once
#include "geometry/frame.h"
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum move_kind {
    MOVE_NONE,   /* the segment stays */
    MOVE_ANGLES, /* translation and angles about a pivot */
    MOVE_RIGID   /* the whole motion, of the chin too */
} move_kind;

typedef struct segment_move {
    move_kind kind;
    double translate_mm[3]; /* along the file's axes, LPS */
    double pitch_deg, yaw_deg, roll_deg;
    double pivot_mm[3]; /* LPS */
    rigid motion;       /* of MOVE_RIGID */
} segment_move;

/* The six ways to move a piece of bone: along the head's axes, mm, and about them, degrees with the signs above. */
typedef enum rig_axis {
    RIG_FORWARD,
    RIG_UP,
    RIG_LEFT, /* the patient's */
    RIG_PITCH,
    RIG_YAW,
    RIG_ROLL,
    RIG_AXES
} rig_axis;

/* The whole mandible about the condyles (q_m). Zero: the jaw stays closed. */
typedef struct jaw_motion {
    double open_deg;       /* about the axis through both condyles */
    double yaw_deg;        /* about the head's vertical */
    double roll_deg;       /* about the head's front-back axis */
    double protrude_mm;    /* forwards along the condylar path */
    double path_slope_deg; /* of that path below the Frankfort horizontal */
} jaw_motion;

typedef struct rig_controls {
    segment_move move[SEGMENT_COUNT]; /* of the chin, but for MOVE_RIGID: relative to the distal segment, at rest */
    jaw_motion jaw;
} rig_controls;

rig_controls rig_controls_default(void); /* nothing moves */

/* Rest to planned position of every segment. The chin rides on the distal segment: its own move first, then
 * the distal one's; as MOVE_RIGID it has its whole motion and does not ride. A proximal segment that is not named
 * stays, so its condyle keeps its seat. The jaw motion comes last and carries distal, chin and both proximal segments
 * together. condyle: left, right, in mm LPS; needed (else NULL) by a jaw motion. Refuses (ERR_INPUT) numbers that are
 * not finite, a moved cranium, a jaw motion without condyles or with condyles less than 40 mm apart or on the wrong
 * sides. */
bool rig_motion(const rig_controls *c, const head_frame *f, const double (*condyle)[3], rigid motion[SEGMENT_COUNT],
                err *e) MUST_CHECK;

/* One move of a segment, as above. */
rigid rig_segment_motion(const segment_move *m, const head_frame *f);
/* Adds a shift of `by` mm, or a turn of `by` degrees, to a move; one that is none becomes MOVE_ANGLES. A whole motion
 * (MOVE_RIGID) takes shifts only. */
void rig_move(segment_move *m, rig_axis axis, double by, const head_frame *f);
/* How far a move with angles shifts along or turns about an axis, mm or degrees. */
double rig_moved(const segment_move *m, rig_axis axis, const head_frame *f);
double *rig_angle(segment_move *m, rig_axis axis);  /* RIG_PITCH, RIG_YAW or RIG_ROLL */
double *rig_jaw_part(jaw_motion *j, rig_axis axis); /* a turn, or RIG_FORWARD: protrusion */
/* The angles of a motion's rotation in the same order and sense: turning by them gives it back. |roll| <= 90. */
void rig_angles(const rigid *motion, const head_frame *f, double *pitch_deg, double *yaw_deg, double *roll_deg);
/* The jaw alone: x -> c + glide + yaw(roll(open(x - c))), c midway between the condyles. */
rigid rig_jaw_motion(const jaw_motion *j, const head_frame *f, const double condyle[2][3]);

#ifdef __cplusplus
}
#endif
