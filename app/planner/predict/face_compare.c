#include "app/planner/predict/face_compare.h"
#include "geometry/face_fit.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/smoothed_motion.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

void face_compare_free(face_compare *c)
{
    for (int k = 0; k < PREDICTION_COUNT; k++) {
        surface_free(&c->skin[k]);
        free(c->signed_mm[k]);
    }
    landmarks_free(&c->points);
    landmarks_free(&c->actual_points);
    landmarks_free(&c->rest_points);
    face_map_free(&c->map);
    *c = (face_compare){0};
}

static bool load_outcome(const char *folder, face_compare *c, err *e)
{
    outcome_record r = {0};
    segments at_rest = {0};
    rigid move[SEGMENT_COUNT];
    bool ok = outcome_record_read(folder, &r, e) && outcome_skin_read(folder, true, &c->skin[PREDICTED], e) &&
              outcome_skin_read(folder, false, &c->skin[NO_CHANGE], e) &&
              outcome_segments_read(folder, &r, &at_rest, move, e);
    if (ok && c->skin[PREDICTED].vertex_count != c->skin[NO_CHANGE].vertex_count)
        ok = err_at(e, ERR_INPUT, folder, 0, NULL, "the skin before and after have different vertices");
    /* regions by the face before: the same vertices for all predictions */
    ok = ok && face_map_make(&c->skin[NO_CHANGE], &r.before, &c->map, e);
    if (ok) {
        c->predictions = PREDICTION_COUNT;
        c->points = landmarks_copy(&r.after);
        c->rest_points = landmarks_copy(&r.before);
        c->frame = r.frame;
        c->skin[SMOOTHED_BONE] = surface_copy(&c->skin[NO_CHANGE]);
        ok = smoothed_motion(&c->skin[NO_CHANGE], c->map.region, &at_rest, move, c->skin[SMOOTHED_BONE].xyz, e);
    }
    outcome_record_free(&r);
    segments_free(&at_rest);
    return ok;
}

static bool load_mesh(const face_compare_input *in, face_compare *c, err *e)
{
    if (!in->landmarks)
        return err_set(e, ERR_USAGE, "%s is a mesh: name the landmarks of that face with --landmarks", in->predicted);
    c->predictions = 1;
    return mesh_read_surface(in->predicted, MESH_SPACE_FROM_FILE, &c->skin[PREDICTED], NULL, e) &&
           landmarks_read(in->landmarks, &c->points, NULL, e) && head_frame_from_landmarks(&c->points, &c->frame, e) &&
           face_map_make(&c->skin[PREDICTED], &c->points, &c->map, e);
}

static bool load_actual(const face_compare_input *in, surface *skin, landmarks *points, err *e)
{
    bool outcome = is_outcome(in->actual);
    if (outcome) {
        outcome_record r = {0};
        if (!outcome_record_read(in->actual, &r, e)) return false;
        if (!in->actual_landmarks) *points = landmarks_copy(&r.after);
        outcome_record_free(&r);
    }
    return (outcome ? outcome_skin_read(in->actual, true, skin, e)
                    : mesh_read_surface(in->actual, MESH_SPACE_FROM_FILE, skin, NULL, e)) &&
           (!in->actual_landmarks || landmarks_read(in->actual_landmarks, points, NULL, e));
}

static void summarise(face_compare *c, int k)
{
    int32_t n = c->map.vertex_count;
    uint8_t *face = NEW_ARRAY(uint8_t, n);
    for (int32_t v = 0; v < n; v++) face[v] = c->map.region[v] != FACE_OUTSIDE;
    for (int r = 0; r < ROW_LOWER; r++)
        c->row[k][r] = distance_summary(c->signed_mm[k], c->map.region, (uint8_t)(r + 1), n);
    c->row[k][ROW_LOWER] = distance_summary(c->signed_mm[k], c->map.lower, 1, n);
    c->row[k][ROW_FACE] = distance_summary(c->signed_mm[k], face, 1, n);
    free(face);
}

/* How far the turn of the alignment alone, about the middle of the stable skin, moves the chin. */
static double turn_at_chin(const face_compare *c)
{
    const surface *s = &c->skin[PREDICTED];
    double middle[2][3] = {{0}}, arm[3], turned[3], count[2] = {0};
    for (int32_t v = 0; v < s->vertex_count; v++) {
        bool chin = c->map.region[v] == FACE_CHIN;
        if (!chin && !c->map.stable[v]) continue;
        vec_add(middle[chin], s->xyz + 3 * (size_t)v, middle[chin]);
        count[chin]++;
    }
    for (int k = 0; k < 2; k++) vec_scale(middle[k], 1 / count[k], middle[k]);
    vec_sub(middle[1], middle[0], arm);
    rigid_rotate(&c->fit.move, arm, turned);
    return vec_distance(arm, turned);
}

static bool measure(face_compare *c, surface *actual, bool align, err *e)
{
    /* What the jaws do not move is the same in all predictions. */
    if (align) {
        if (!face_fit(actual, &c->skin[PREDICTED], &c->map, &c->fit, e)) return false;
        c->aligned = true;
        c->turn_at_chin_mm = turn_at_chin(c);
        surface_transform(actual, &c->fit.move);
        for (int32_t i = 0; i < c->actual_points.count; i++) {
            double *p = c->actual_points.point[i].xyz;
            rigid_apply(&c->fit.move, p, p);
        }
    }
    for (int k = 0; k < c->predictions; k++) {
        face_outward(&c->skin[k], &c->map, c->frame.posterior); /* a sign is "in front", whatever the triangles */
        c->signed_mm[k] = NEW_ARRAY(double, c->skin[k].vertex_count);
        if (!surface_signed_distance(&c->skin[k], actual, c->signed_mm[k], e)) return false;
        summarise(c, k);
    }
    if (!c->row[PREDICTED][ROW_FACE].count)
        return err_set(e, ERR_GEOMETRY, "no point of the face could be compared: the other surface does not cover it");
    return true;
}

bool face_compare_make(const face_compare_input *in, face_compare *out, err *e)
{
    face_compare c = {0};
    surface actual = {0};
    bool outcome = is_outcome(in->predicted);
    if (outcome && in->landmarks)
        return err_set(e, ERR_USAGE, "%s is an outcome and has its own landmarks: leave --landmarks out",
                       in->predicted);
    bool ok = (outcome ? load_outcome(in->predicted, &c, e) : load_mesh(in, &c, e)) &&
              load_actual(in, &actual, &c.actual_points, e) && measure(&c, &actual, in->align, e);
    surface_free(&actual);
    if (ok)
        *out = c;
    else
        face_compare_free(&c);
    return ok;
}
