#include "app/planner/predict/face_compare.h"
#include "geometry/vec.h"
#include <math.h>

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

static json_t *landmarks_json(const face_compare *c)
{
    json_t *list = json_array();
    double d[3];
    for (int32_t i = 0; i < c->points.count; i++) {
        if (!face_compare_landmark(c, &c->points, i, d)) continue;
        json_t *one = json_pack("{ss sf s[fff]}", "label", c->points.point[i].label, "error_mm", vec_norm(d),
                                "forward_up_left_mm", d[0], d[1], d[2]);
        if (c->rest_points.count && face_compare_landmark(c, &c->rest_points, i, d))
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

bool face_compare_beats(const face_compare *c, int row)
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
        for (int r = 0; r < ROW_COUNT; r++)
            json_object_set_new(closer, face_row_name(r), json_boolean(face_compare_beats(c, r)));
        json_object_set_new(out, "closer_than_both_trivial", closer);
    }
    return out;
}
