/* The fields of a plan, one line each. */
#include "app/planner/plan/plan_file.h"
#include <math.h>
#include <pthread.h>

/* A row of the controls as a field. */
#define CONTROL_FIELD(id, name_, unit_, kind_, segment_, axis_, low_, high_, default_, built_, audit_, title_, help_)  \
    {                                                                                                                  \
        .name = name_, .kind = FIELD_NUMBER, .offset = offsetof(plan_file, value[CONTROL_##id]), .unit = unit_,        \
        FROM(low_), TO(high_), .help = (built_) ? (help_) : CONTROL_NOT_BUILT                                          \
    }

#define SEGMENT_ANGLE(member, help_)                                                                                   \
    {                                                                                                                  \
        .name = #member, .kind = FIELD_NUMBER, .offset = offsetof(plan_segment, move.member), .unit = "deg",           \
        FROM(-90), TO(90), .help = help_                                                                               \
    }

static const field rows[] = {
    {.name = "gnathos",
     .kind = FIELD_VERSION,
     .offset = offsetof(plan_file, version),
     .required = true,
     .help = "Version of the format."},
    {.name = "name",
     .kind = FIELD_TEXT,
     .offset = offsetof(plan_file, name),
     .help = "Shown in results; the file's name where absent."},
#define X(...) CONTROL_FIELD(__VA_ARGS__),
    CONTROLS_OF_SEGMENTS(X)
#undef X
        {.name = "override",
         .kind = FIELD_TEXT,
         .offset = offsetof(plan_file, override),
         .help = "The reason why this plan may go beyond the case's limits; shown in results."},
    {.name = "segments",
     .kind = FIELD_OTHER,
     .words = "an object with maxilla, distal, proximal_left, proximal_right, chin",
     .help = "Any rigid move of a segment, in place of the short fields above."},
    {.name = "load_steps",
     .kind = FIELD_COUNT,
     .offset = offsetof(plan_file, load_steps),
     FROM(1),
     TO(100),
     .help = "Number of equal parts in which the bones are moved."},
#define X(...) CONTROL_FIELD(__VA_ARGS__),
    CONTROLS_OF_JAW(X)
#undef X
        {.name = "expressions",
         .kind = FIELD_OTHER,
         .words = "a list of six numbers from 0 to 1",
         .help = CONTROL_NOT_BUILT},
#define X(...) CONTROL_FIELD(__VA_ARGS__),
    CONTROLS_OF_REST(X)
#undef X
};

static const field segment_rows[] = {
    {.name = "translate_mm",
     .kind = FIELD_VEC3,
     .offset = offsetof(plan_segment, move.translate_mm),
     .unit = "mm",
     FROM(-100),
     TO(100),
     .help = "Translation after the rotation, along the file's axes (LPS)."},
    SEGMENT_ANGLE(pitch_deg, "Rotation about the head's left axis; positive turns the front down."),
    SEGMENT_ANGLE(yaw_deg, "Rotation about the head's vertical; positive turns the front to the left."),
    SEGMENT_ANGLE(roll_deg, "Rotation about the head's front-back axis; positive turns the left side down."),
    {.name = "pivot",
     .kind = FIELD_OTHER,
     .words = "the label of a landmark, or three numbers [x, y, z] in mm",
     .help = "Where the rotation's axes meet; the segment's incisor, pogonion or condylion where absent."},
    {.name = "matrix",
     .kind = FIELD_OTHER,
     .words = "a list of 16 numbers, row by row",
     .help = "The whole move of the bone as a matrix (LPS, mm), in place of translation and angles."},
    {.name = "file",
     .kind = FIELD_FILE,
     .offset = offsetof(plan_segment, file),
     .help = "The whole move as a transform saved by 3D Slicer as text (.tfm), in place of all others."},
};

static plan_file plan_defaults; /* filled once */
static void set_defaults(void) { plan_defaults = plan_file_default(); }

const field_table *plan_fields(void)
{
    static const field_table table = {"A plan, one set of bone moves:", rows, sizeof rows / sizeof rows[0],
                                      &plan_defaults};
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_defaults);
    return &table;
}

const field_table *plan_segment_fields(void)
{
    static const plan_segment defaults;
    static const field_table table = {"Each segment in \"segments\":", segment_rows,
                                      sizeof segment_rows / sizeof segment_rows[0], &defaults};
    return &table;
}
