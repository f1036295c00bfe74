/* The fields of a plan, one line each. */
#include "app/planner/plan/plan_file.h"
#include "geometry/suggest.h"
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
     .help =
         "The whole move of the bone as a matrix (LPS, mm), in place of translation and angles; of the chin too, which "
         "otherwise rides on the distal segment."},
    {.name = "file",
     .kind = FIELD_FILE,
     .offset = offsetof(plan_segment, file),
     .help =
         "The whole move, as by a matrix, as a transform saved by 3D Slicer as text (.tfm), in place of all others."},
};

/* `"roll_deg": 3`, or `"translate_mm": [0, -3, 0]`: along the file's axes, which are about those of the head. */
static void say_member(rig_axis axis, const json_t *value, char *text, size_t size)
{
    static const char *const angle[RIG_AXES] = {
        [RIG_PITCH] = "pitch_deg", [RIG_YAW] = "yaw_deg", [RIG_ROLL] = "roll_deg"};
    double v = json_is_number(value) ? json_number_value(value) : 1;
    if (axis >= RIG_PITCH)
        snprintf(text, size, "\"%s\": %g", angle[axis], v);
    else
        snprintf(text, size, "\"translate_mm\": [%g, %g, %g]", axis == RIG_LEFT ? v : 0,
                 axis == RIG_FORWARD && v != 0 ? -v : 0, axis == RIG_UP ? v : 0);
}

/* An audit has six words for each piece, a plan has short fields for four of these. */
static bool say_place(const char *key, const json_t *value, char *text, size_t size)
{
    segment_id s;
    rig_axis axis;
    char member[96];
    if (!control_words(key, &s, &axis)) return false;
    for (int i = 0; i < CONTROL_COUNT; i++)
        if (controls[i].kind == CONTROL_OF_SEGMENT && controls[i].segment == s && controls[i].axis == axis) {
            snprintf(text, size, "did you mean \"%s\"?", controls[i].name);
            return true;
        }
    say_member(axis, value, member, sizeof member);
    snprintf(text, size, "its place is \"segments\": {\"%s\": {%s}}", segment_name(s), member);
    return true;
}

static bool plan_hint(const char *key, const json_t *value, char *text, size_t size)
{
    enum { ROWS = sizeof rows / sizeof rows[0] };
    control piece[CONTROL_PIECE_MAX];
    const char *names[ROWS + CONTROL_PIECE_MAX];
    char place[256];
    if (say_place(key, value, text, size)) return true;
    for (int i = 0; i < ROWS; i++) names[i] = rows[i].name;
    for (int i = 0; i < CONTROL_PIECE_MAX; i++) {
        control_of_piece(i, &piece[i]);
        names[ROWS + i] = piece[i].name;
    }
    int near = suggest_nearest(key, names, ROWS + CONTROL_PIECE_MAX);
    if (near < ROWS || !say_place(names[near], value, place, sizeof place)) return false;
    snprintf(text, size, "did you mean \"%s\"? I%s", names[near], place + 1);
    return true;
}

static bool segment_hint(const char *key, const json_t *value, char *text, size_t size)
{
    rig_axis axis;
    char member[96];
    if (say_place(key, value, text, size)) return true;
    if (!control_axis(key, &axis)) return false;
    say_member(axis, value, member, sizeof member);
    snprintf(text, size, "its place is %s", member);
    return true;
}

static plan_file plan_defaults; /* filled once */
static void set_defaults(void) { plan_defaults = plan_file_default(); }

const field_table *plan_fields(void)
{
    static const field_table table = {"A plan, one set of bone moves:", rows, sizeof rows / sizeof rows[0],
                                      &plan_defaults, plan_hint};
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_defaults);
    return &table;
}

const field_table *plan_segment_fields(void)
{
    static const plan_segment defaults;
    static const field_table table = {"Each segment in \"segments\":", segment_rows,
                                      sizeof segment_rows / sizeof segment_rows[0], &defaults, segment_hint};
    return &table;
}
