#include "app/planner/predict/compare_record.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/vec.h"
#include <math.h>
#include <string.h>

const char *prediction_name(prediction_kind k)
{
    static const char *const name[PREDICTION_COUNT] = {"prediction", "no_change", "smoothed_bone"};
    return name[k];
}

const char *face_row_name(int row)
{
    return row == ROW_LOWER ? "lower face" : row == ROW_FACE ? "face" : face_region_name((face_region)(row + 1));
}

bool face_compare_landmark(const face_compare *c, const landmarks *predicted, int32_t i, double out[3])
{
    const landmark *p = &predicted->point[i], *q = landmarks_find(&c->actual_points, p->label);
    double d[3];
    if (!q) return false;
    vec_sub(q->xyz, p->xyz, d);
    out[0] = -vec_dot(d, c->frame.posterior);
    out[1] = vec_dot(d, c->frame.up);
    out[2] = vec_dot(d, c->frame.left);
    return true;
}

bool face_compare_on_skin(const char *label)
{
    const landmark_row *row = landmark_row_find(label);
    return row ? row->on == CASE_SKIN : strchr(label, '\'') != NULL;
}

bool face_compare_beats(const face_compare *c, int row)
{
    double own = c->row[PREDICTED][row].mean_abs;
    return own < c->row[NO_CHANGE][row].mean_abs && own < c->row[SMOOTHED_BONE][row].mean_abs;
}

static const record_row stats_row[] = {
    ROW(distance_stats, count, "points", NULL, "vertices that were compared"),
    ROW(distance_stats, left_out, "left_out", NULL, "vertices that the actual face does not cover"),
    ROW(distance_stats, mean, "mean_mm", "mm", "mean signed distance"),
    ROW(distance_stats, mean_abs, "mean_abs_mm", "mm", "mean distance"),
    ROW(distance_stats, rms, "rms_mm", "mm", "root mean square"),
    ROW(distance_stats, p90, "p90_abs_mm", "mm", "distance that 90 % do not exceed"),
    ROW(distance_stats, p95, "p95_abs_mm", "mm", "distance that 95 % do not exceed"),
    ROW(distance_stats, under_1, "share_under_1_mm", NULL, "share that is nearer than 1 mm"),
    ROW(distance_stats, under_2, "share_under_2_mm", NULL, "share that is nearer than 2 mm"),
};
static const record_table stats_table = {.title = "Distances over a region", RECORD_ROWS(stats_row)};

typedef struct compared_landmark {
    const char *label;
    double error_mm, along_mm[3], unchanged_mm, smoothed_mm;
} compared_landmark;

static const record_row compared_row[] = {
    ROW(compared_landmark, label, "label", NULL, "its label"),
    ROW(compared_landmark, error_mm, "error_mm", "mm", "distance of the actual from the predicted one"),
    ROW(compared_landmark, along_mm, "forward_up_left_mm", "mm", "the same along the head's own axes"),
    ROW_OPTIONAL(compared_landmark, unchanged_mm, "no_change_error_mm", "mm", "distance of the actual one from before"),
    ROW_OPTIONAL(compared_landmark, smoothed_mm, "smoothed_bone_error_mm", "mm",
                 "distance of the actual one from where the smoothed motion of the bones takes it; of skin only"),
};
static const record_table landmark_table = {.title = "A landmark compared", RECORD_ROWS(compared_row)};

const char *face_compare_aligned_on(const face_compare *c)
{
    return c->on == ALIGN_NONE ? "as registered: both faces taken as they lie"
           : c->on == ALIGN_SKIN
               ? "skin that no operation of the jaws moves: forehead, dorsum of the nose over its bones, sides of the orbits"
           : c->one_case ? "bone: both are outcomes of one case, whose cranium stays"
                         : "bone: the front of the cranium";
}

typedef struct alignment {
    double matrix[16], turn_deg;
    face_alignment a;
} alignment;

static const record_row move_row[] = {
    ROW(alignment, matrix, "matrix", NULL, "how the actual face is moved: row-major, mm"),
    ROW(alignment, turn_deg, "turn_deg", "degrees", "angle of that move"),
    ROW(alignment, a.turn_at_chin_mm, "turn_at_chin_mm", "mm", "what that turn alone moves the chin by"),
    ROW(alignment, a.chin_mm, "chin_mm", "mm", "what the whole move moves the chin by"),
    ROW(alignment, a.fit.points, "points", NULL, "vertices of the region"),
    ROW(alignment, a.fit.used, "used", NULL, "of them, used"),
    ROW(alignment, a.fit.iterations, "iterations", NULL, "steps of the alignment"),
    ROW(alignment, a.fit.rms_before_mm, "rms_before_mm", "mm", "root mean square distance before"),
    ROW(alignment, a.fit.rms_after_mm, "rms_after_mm", "mm", "and after"),
};
static const record_table move_table = {.title = "A move of the actual face", RECORD_ROWS(move_row)};

static alignment move_of(const face_alignment *a)
{
    alignment out = {.turn_deg = rigid_angle(&a->fit.move) * (180 / acos(-1.0)), .a = *a};
    rigid_to_matrix(&a->fit.move, out.matrix);
    return out;
}

typedef struct comparison {
    const face_compare *of;
    const char *predicted, *actual, *sign;
} comparison;

static const void *move_into(const face_alignment *a, void *space)
{
    if (!a->known) return NULL;
    *(alignment *)space = move_of(a);
    return space;
}

static const void *aligned(const void *of, void *space)
{
    return move_into(&((const comparison *)of)->of->aligned, space);
}

static const void *by_skin(const void *of, void *space)
{
    return move_into(&((const comparison *)of)->of->by_skin, space);
}

static const char *aligned_on(const void *of, char *space)
{
    (void)space;
    return face_compare_aligned_on(((const comparison *)of)->of);
}

static const void *next_row(const void *of, prediction_kind k, int *i, const char **key)
{
    if (*i == ROW_COUNT) return NULL;
    *key = face_row_name(*i);
    return &((const comparison *)of)->of->row[k][*i];
}

#define NEXT_ROW(name, kind)                                                                                           \
    static const void *name(const void *of, int *i, const char **key, void *space)                                     \
    {                                                                                                                  \
        (void)space;                                                                                                   \
        return next_row(of, kind, i, key);                                                                             \
    }
NEXT_ROW(next_predicted, PREDICTED)
NEXT_ROW(next_no_change, NO_CHANGE)
NEXT_ROW(next_smoothed, SMOOTHED_BONE)

static const void *next_beaten(const void *of, int *i, const char **key, void *space)
{
    if (*i == ROW_COUNT) return NULL;
    *key = face_row_name(*i);
    *(bool *)space = face_compare_beats(((const comparison *)of)->of, *i);
    return space;
}

static const void *next_landmark(const void *of, int *i, const char **key, void *space)
{
    const face_compare *c = ((const comparison *)of)->of;
    compared_landmark *out = space;
    double d[3];
    (void)key;
    while (*i < c->points.count && !face_compare_landmark(c, &c->points, *i, out->along_mm)) ++*i;
    if (*i >= c->points.count) return NULL;
    out->label = c->points.point[*i].label;
    out->error_mm = vec_norm(out->along_mm);
    bool known = c->rest_points.count && face_compare_landmark(c, &c->rest_points, *i, d);
    out->unchanged_mm = known ? vec_norm(d) : (double)NAN;
    known = c->smoothed_points.count && face_compare_on_skin(out->label) &&
            face_compare_landmark(c, &c->smoothed_points, *i, d);
    out->smoothed_mm = known ? vec_norm(d) : (double)NAN;
    return out;
}

static bool has_landmarks(const void *of) { return ((const comparison *)of)->of->actual_points.count > 0; }
static bool has_trivial(const void *of) { return ((const comparison *)of)->of->predictions > 1; }

#define REGIONS(next_, name_, when_, help_)                                                                            \
    {                                                                                                                  \
        .kind = RECORD_MAP, .next = next_, .item = RECORD_OBJECT, .table = &stats_table, .key = "region",              \
        .name = name_, .when = when_, .help = help_                                                                    \
    }

static const record_row comparison_row[] = {
    ROW(comparison, predicted, "predicted", NULL, "outcome or mesh of the predicted face"),
    ROW(comparison, actual, "actual", NULL, "outcome or mesh of the actual one"),
    ROW(comparison, sign, "sign", NULL, "what the sign of a distance says"),
    ROW_TEXT(aligned_on, "aligned_on", "what decided where the actual face lies"),
    {.kind = RECORD_OBJECT,
     .at = aligned,
     .table = &move_table,
     .or_null = true,
     .name = "alignment",
     .help = "how the actual face was moved onto the predicted one; null: not at all"},
    {.kind = RECORD_OBJECT,
     .at = by_skin,
     .table = &move_table,
     .or_null = true,
     .name = "by_skin",
     .help = "how skin alone would move it besides, which was not done; null: skin did, or does not tell"},
    REGIONS(next_predicted, "regions.prediction", NULL, "distances of the prediction"),
    REGIONS(next_no_change, "regions.no_change", has_trivial, "distances of the skin before, unchanged"),
    REGIONS(
        next_smoothed, "regions.smoothed_bone", has_trivial,
        "distances of the skin before moved by 0.85 of the bones' own moves, of the 40 nearest bone vertices, smoothed "
        "over 12 mm (Gaussian)"),
    {.kind = RECORD_LIST,
     .next = next_landmark,
     .item = RECORD_OBJECT,
     .table = &landmark_table,
     .when = has_landmarks,
     .name = "landmarks",
     .help = "the landmarks that both faces have"},
    {.kind = RECORD_MAP,
     .next = next_beaten,
     .item = RECORD_BOOL,
     .key = "region",
     .when = has_trivial,
     .name = "closer_than_both_trivial",
     .help = "the prediction is closer than the two trivial ones, by the mean distance"},
};
const record_table comparison_table = {
    .kind = "comparison", .title = "Record of gnathos compare, comparison.json", RECORD_ROWS(comparison_row)};

json_t *face_compare_json(const face_compare_input *in, const face_compare *c)
{
    const comparison v = {.of = c,
                          .predicted = in->predicted,
                          .actual = in->actual,
                          .sign = "positive: the actual face lies in front of the predicted one"};
    return record_json(&comparison_table, &v);
}
