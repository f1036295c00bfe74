#include "app/planner/predict/face_compare.h"
#include "geometry/vec.h"
#include <stdio.h>
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

static json_t *number(double x) { return isfinite(x) ? json_real(x) : json_null(); }

static json_t *rows_json(const distance_stats row[ROW_COUNT])
{
    json_t *out = json_object();
    for (int r = 0; r < ROW_COUNT; r++) {
        const distance_stats *s = row + r;
        json_object_set_new(out, face_row_name(r),
                            json_pack("{si si so so so so so so so}", "points", s->count, "left_out", s->left_out,
                                      "mean_mm", number(s->mean), "mean_abs_mm", number(s->mean_abs), "rms_mm",
                                      number(s->rms), "p90_abs_mm", number(s->p90), "p95_abs_mm", number(s->p95),
                                      "share_under_1_mm", number(s->under_1), "share_under_2_mm", number(s->under_2)));
    }
    return out;
}

/* Actual minus predicted (points, or those before), in the frame of the head: forward, up, left. */
static bool landmark_error(const face_compare *c, const landmarks *predicted, int32_t i, double out[3])
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

static json_t *landmarks_json(const face_compare *c)
{
    json_t *list = json_array();
    double d[3];
    for (int32_t i = 0; i < c->points.count; i++) {
        if (!landmark_error(c, &c->points, i, d)) continue;
        json_t *one = json_pack("{ss sf s[fff]}", "label", c->points.point[i].label, "error_mm", vec_norm(d),
                                "forward_up_left_mm", d[0], d[1], d[2]);
        if (c->rest_points.count && landmark_error(c, &c->rest_points, i, d))
            json_object_set_new(one, "no_change_error_mm", json_real(vec_norm(d)));
        json_array_append_new(list, one);
    }
    return list;
}

static json_t *alignment_json(const face_compare *c)
{
    double m[16];
    if (!c->aligned) return json_null();
    rigid_to_matrix(&c->fit.move, m);
    json_t *matrix = json_array();
    for (int i = 0; i < 16; i++) json_array_append_new(matrix, json_real(m[i]));
    return json_pack("{ss so sf si si si sf sf}", "region", "forehead and nasal bridge, above N", "matrix", matrix,
                     "turn_deg", rigid_angle(&c->fit.move) * (180 / acos(-1.0)), "points", c->fit.points, "used",
                     c->fit.used, "iterations", c->fit.iterations, "rms_before_mm", c->fit.rms_before_mm,
                     "rms_after_mm", c->fit.rms_after_mm);
}

/* Closer than both trivial predictions, by the mean absolute distance. */
static bool beats(const face_compare *c, int row)
{
    double own = c->row[PREDICTED][row].mean_abs;
    return own < c->row[NO_CHANGE][row].mean_abs && own < c->row[SMOOTHED_BONE][row].mean_abs;
}

json_t *face_compare_json(const face_compare_input *in, const face_compare *c)
{
    json_t *regions = json_object();
    for (int k = 0; k < c->predictions; k++)
        json_object_set_new(regions, prediction_name((prediction_kind)k), rows_json(c->row[k]));
    json_t *out = json_pack("{ss ss ss so so}", "predicted", in->predicted, "actual", in->actual, "sign",
                            "positive: the actual face lies in front of the predicted one", "alignment",
                            alignment_json(c), "regions", regions);
    if (c->actual_points.count) json_object_set_new(out, "landmarks", landmarks_json(c));
    if (c->predictions > 1) {
        json_t *closer = json_object();
        for (int r = 0; r < ROW_COUNT; r++) json_object_set_new(closer, face_row_name(r), json_boolean(beats(c, r)));
        json_object_set_new(out, "closer_than_both_trivial", closer);
    }
    return out;
}

static void print_trivial(const face_compare *c)
{
    printf("\nmean |d|, mm    prediction  no change  smoothed bone x 0.85\n");
    for (int r = 0; r < ROW_COUNT; r++)
        printf("%-14s %11.2f %10.2f %13.2f\n", face_row_name(r), c->row[PREDICTED][r].mean_abs,
               c->row[NO_CHANGE][r].mean_abs, c->row[SMOOTHED_BONE][r].mean_abs);
    for (int yes = 1; yes >= 0; yes--) {
        int count = 0;
        for (int r = 0; r < ROW_COUNT; r++) {
            if (beats(c, r) != yes) continue;
            if (!count++)
                printf(yes ? "The prediction is closer than both trivial ones in: " : "It is not closer in: ");
            else
                printf(", ");
            printf("%s", face_row_name(r));
        }
        if (count)
            printf(".\n");
        else if (yes)
            printf("The prediction is nowhere closer than both trivial ones.\n");
    }
}

/* Points of the skin; the file has the bone's as well. */
static bool on_skin(const char *label)
{
    static const char *const bare[] = {"Pn",   "Sn",   "Al_L",    "Al_R", "Ls",  "Stm",
                                       "Stms", "Stmi", "Li_soft", "Ch_L", "Ch_R"};
    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++)
        if (!strcmp(label, bare[i])) return true;
    return strchr(label, '\'') != NULL;
}

static void print_landmarks(const face_compare *c)
{
    bool rest = c->rest_points.count > 0;
    double d[3], unchanged[3] = {0}, sum[2] = {0, 0};
    int count = 0;
    for (int32_t i = 0; i < c->points.count; i++) {
        if (!on_skin(c->points.point[i].label) || !landmark_error(c, &c->points, i, d)) continue;
        if (rest && !landmark_error(c, &c->rest_points, i, unchanged)) continue;
        if (!count++) printf("\nlandmark     error, mm  forward     up   left%s\n", rest ? "  no change" : "");
        printf("%-12s %9.2f %8.2f %6.2f %6.2f", c->points.point[i].label, vec_norm(d), d[0], d[1], d[2]);
        if (rest) printf(" %10.2f", vec_norm(unchanged));
        putchar('\n');
        sum[0] += vec_norm(d);
        sum[1] += vec_norm(unchanged);
    }
    if (count) printf("mean of %-3d  %9.2f", count, sum[0] / count);
    if (count && rest) printf(" %34.2f", sum[1] / count);
    if (count) putchar('\n');
}

void face_compare_print(const face_compare *c)
{
    if (c->aligned)
        printf("aligned on forehead and nasal bridge: turned %.2f deg, RMS %.3f -> %.3f mm over %d of %d points\n\n",
               rigid_angle(&c->fit.move) * (180 / acos(-1.0)), c->fit.rms_before_mm, c->fit.rms_after_mm, c->fit.used,
               c->fit.points);
    else
        printf("not aligned: both faces taken as they lie\n\n");
    printf("signed distance, mm: positive where the actual face lies in front of the predicted one\n");
    printf("%-12s %7s %7s %7s %7s %7s %7s  %6s %6s\n", "", "points", "mean", "mean|d|", "RMS", "90 %", "95 %", "< 1 mm",
           "< 2 mm");
    for (int r = 0; r < ROW_COUNT; r++) {
        const distance_stats *s = &c->row[PREDICTED][r];
        printf("%-12s %7d ", face_row_name(r), s->count);
        if (s->count)
            printf("%+7.2f %7.2f %7.2f %7.2f %7.2f  %4.0f %% %4.0f %%\n", s->mean, s->mean_abs, s->rms, s->p90, s->p95,
                   100 * s->under_1, 100 * s->under_2);
        else
            printf("      - not covered by the actual face\n");
    }
    if (c->predictions > 1) print_trivial(c);
    print_landmarks(c);
}
