/* controls: the numbers that a plan sets, in one table. Plan file, help, audit, remedies, study and rig read it: a new
 * control is a new row here. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "geometry/rig.h"

/* X(ID, name in a plan, unit, kind, segment, axis, low, high, default, built, audit, title, help).
 *
 * Range: what a plan may say at all; how far a move is allowed is said by the limits of moves (limit.h), which carry
 * the names of the controls. A control that is not built is refused unless it stays at its default. audit: what an
 * audit finds without being told, the bounds of it alone (LINE) or these and its place in the box of all BOX controls.
 * title: what a positive value does. */
#define CONTROLS_OF_SEGMENTS(X)                                                                                        \
    X(MAXILLA_ADVANCE, "maxilla_advance_mm", "mm", SEGMENT, SEGMENT_MAXILLA, RIG_FORWARD, -100, 100, 0, true, BOX,     \
      "maxilla forwards", "Maxilla forwards (backwards where negative).")                                              \
    X(MAXILLA_IMPACTION, "maxilla_impaction_mm", "mm", SEGMENT, SEGMENT_MAXILLA, RIG_UP, -100, 100, 0, true, BOX,      \
      "maxilla upwards (impaction)", "Maxilla upwards (downwards where negative).")                                    \
    X(MANDIBLE_ADVANCE, "mandible_advance_mm", "mm", SEGMENT, SEGMENT_DISTAL, RIG_FORWARD, -100, 100, 0, true, BOX,    \
      "mandible forwards", "Distal segment of the mandible forwards.")                                                 \
    X(CHIN_ADVANCE, "chin_advance_mm", "mm", SEGMENT, SEGMENT_CHIN, RIG_FORWARD, -100, 100, 0, true, LINE,             \
      "chin forwards", "Chin forwards, relative to the distal segment.")

/* The whole mandible about the condyles. */
#define CONTROLS_OF_JAW(X)                                                                                             \
    X(JAW_PITCH, "jaw.pitch_deg", "deg", JAW, SEGMENT_DISTAL, RIG_PITCH, -100, 100, 0, false, NONE, "jaw opens",       \
      "Opening of the jaw about the axis through both condyles.")                                                      \
    X(JAW_YAW, "jaw.yaw_deg", "deg", JAW, SEGMENT_DISTAL, RIG_YAW, -100, 100, 0, false, NONE, "jaw to the left",       \
      "Turn of the jaw about the head's vertical; positive turns the front to the left.")                              \
    X(JAW_ROLL, "jaw.roll_deg", "deg", JAW, SEGMENT_DISTAL, RIG_ROLL, -100, 100, 0, false, NONE, "jaw left side down", \
      "Turn of the jaw about the head's front-back axis; positive turns the left side down.")                          \
    X(JAW_PROTRUDE, "jaw.protrude_mm", "mm", JAW, SEGMENT_DISTAL, RIG_FORWARD, -100, 100, 0, false, NONE,              \
      "jaw forwards", "The jaw forwards along the path of the condyles.")

/* In a plan one list; they move no bone. */
#define CONTROLS_OF_EXPRESSIONS(X)                                                                                     \
    X(EXPRESSION_0, "expressions[0]", NULL, EXPRESSION, 0, 0, 0, 1, 0, false, NONE, "first expression", "")            \
    X(EXPRESSION_1, "expressions[1]", NULL, EXPRESSION, 0, 0, 0, 1, 0, false, NONE, "second expression", "")           \
    X(EXPRESSION_2, "expressions[2]", NULL, EXPRESSION, 0, 0, 0, 1, 0, false, NONE, "third expression", "")            \
    X(EXPRESSION_3, "expressions[3]", NULL, EXPRESSION, 0, 0, 0, 1, 0, false, NONE, "fourth expression", "")           \
    X(EXPRESSION_4, "expressions[4]", NULL, EXPRESSION, 0, 0, 0, 1, 0, false, NONE, "fifth expression", "")            \
    X(EXPRESSION_5, "expressions[5]", NULL, EXPRESSION, 0, 0, 0, 1, 0, false, NONE, "sixth expression", "")

#define CONTROLS_OF_REST(X)                                                                                            \
    X(REST, "rest", NULL, REST, 0, 0, 0, 1, 0, false, NONE, "muscles at rest", "Share of the face at rest.")

#define CONTROLS(X) CONTROLS_OF_SEGMENTS(X) CONTROLS_OF_JAW(X) CONTROLS_OF_EXPRESSIONS(X) CONTROLS_OF_REST(X)
#define CONTROL_NOT_BUILT "Not built yet: only 0 is accepted."

typedef enum control_id {
#define X(id, ...) CONTROL_##id,
    CONTROLS(X)
#undef X
        CONTROL_COUNT
} control_id;

typedef enum control_kind {
    CONTROL_OF_SEGMENT,    /* moves its segment along or about its axis (rig.h) */
    CONTROL_OF_JAW,        /* moves the whole mandible along or about its axis */
    CONTROL_OF_EXPRESSION, /* moves no bone */
    CONTROL_OF_REST        /* moves no bone */
} control_kind;

typedef enum control_audit { CONTROL_AUDIT_NONE, CONTROL_AUDIT_LINE, CONTROL_AUDIT_BOX } control_audit;

typedef struct control {
    char name[40];
    const char *unit; /* "mm", "deg" or NULL */
    control_kind kind;
    segment_id segment;
    rig_axis axis;
    double low, high, usual; /* usual: the default */
    bool built;
    control_audit audit;
    const char *title; /* NULL of a control without a row */
} control;

extern const control controls[CONTROL_COUNT];

/* Every segment that is cut free has six controls, along and about the head's axes: PIECE_advance_mm, _lift_mm,
 * _lateral_mm, _pitch_deg, _yaw_deg, _roll_deg for the pieces maxilla, mandible, chin, proximal_left and
 * proximal_right. Where the table has a row for a segment and an axis, that row and its name stand for it. */
enum { CONTROL_PIECES = 5, CONTROL_PIECE_MAX = CONTROL_PIECES * RIG_AXES };
void control_of_piece(int number, control *out); /* number: 0 <= number < CONTROL_PIECE_MAX, by piece, then axis */
const char *control_piece_name(segment_id s);    /* "mandible" of the distal segment, else segment_name */
int control_piece_named(const char *name);       /* the segment of that piece, or -1 */
/* Piece and axis of the name of one of a piece, or of its segment's ("distal_yaw_deg"); where the table has a row for
 * it that is found too. false if there is none of that name. */
bool control_words(const char *name, segment_id *s, rig_axis *axis) MUST_CHECK;
/* The axis of "advance_mm" or "roll_deg". */
bool control_axis(const char *name, rig_axis *axis) MUST_CHECK;
/* Any control, of the table or of a piece; false if there is none of that name. */
bool control_named(const char *name, control *out) MUST_CHECK;
/* One of a piece, as the case bounds it: low and high are the stop range of its limit of moves. Refuses (ERR_USAGE)
 * another name, with the nearest one; (ERR_INPUT) a piece that the case does not cut. */
bool control_find(const char *name, const case_file *c, control *out, err *e) MUST_CHECK;
/* The limit of moves that a shift or a turn of a segment counts for. */
limit_id control_limit(segment_id s, rig_axis axis);

/* What a control does: adds `value` of it to the moves. An expression moves no bone. */
void control_apply(const control *x, double value, const head_frame *f, rig_controls *to);
