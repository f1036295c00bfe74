#include "app/planner/predict/face_compare.h"
#include "geometry/face_fit.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/smoothed_motion.h"
#include "geometry/vec.h"
#include <stdio.h>
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
    landmarks_free(&c->smoothed_points);
    surface_free(&c->cranium);
    surface_free(&c->actual_cranium);
    face_map_free(&c->map);
    *c = (face_compare){0};
}

static const char *case_hash(const outcome_record *r)
{
    return json_string_value(json_object_get(r->file.root, "case_hash"));
}

/* The skin and its landmarks before, as they follow the bones that the prediction moves. */
static bool follow_bones(const segments *at_rest, const rigid move[SEGMENT_COUNT], face_compare *c, err *e)
{
    landmarks *l = &c->smoothed_points;
    surface at = surface_new(c->rest_points.count, 0);
    double *after = NEW_ARRAY(double, 3 * (size_t)at.vertex_count);
    uint8_t *all = NEW_ARRAY(uint8_t, at.vertex_count);
    *l = landmarks_copy(&c->rest_points);
    for (int32_t i = 0; i < l->count; i++) {
        vec_copy(l->point[i].xyz, at.xyz + 3 * (size_t)i);
        all[i] = face_compare_on_skin(l->point[i].label);
    }
    c->skin[SMOOTHED_BONE] = surface_copy(&c->skin[NO_CHANGE]);
    bool ok = smoothed_motion(&at, all, at_rest, move, after, e) &&
              smoothed_motion(&c->skin[NO_CHANGE], c->map.region, at_rest, move, c->skin[SMOOTHED_BONE].xyz, e);
    for (int32_t i = 0; ok && i < l->count; i++) vec_copy(after + 3 * (size_t)i, l->point[i].xyz);
    free(after);
    free(all);
    surface_free(&at);
    return ok;
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
        snprintf(c->case_hash, sizeof c->case_hash, "%s", case_hash(&r) ? case_hash(&r) : "");
        c->cranium = surface_copy(&at_rest.part[SEGMENT_CRANIUM]);
        ok = follow_bones(&at_rest, move, c, e);
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

/* Skin, landmarks and cranium of another outcome. */
static bool load_actual_outcome(const face_compare_input *in, face_compare *c, surface *skin, err *e)
{
    outcome_record r = {0};
    segments at_rest = {0};
    rigid move[SEGMENT_COUNT];
    bool ok = outcome_record_read(in->actual, &r, e) && outcome_skin_read(in->actual, true, skin, e);
    if (ok && !in->actual_landmarks) c->actual_points = landmarks_copy(&r.after);
    c->one_case = ok && *c->case_hash && case_hash(&r) && !strcmp(c->case_hash, case_hash(&r));
    if (ok && !c->one_case && c->cranium.vertex_count) {
        ok = outcome_segments_read(in->actual, &r, &at_rest, move, e);
        if (ok) c->actual_cranium = surface_copy(&at_rest.part[SEGMENT_CRANIUM]);
    }
    outcome_record_free(&r);
    segments_free(&at_rest);
    return ok;
}

static bool load_actual(const face_compare_input *in, face_compare *c, surface *skin, err *e)
{
    bool outcome = is_outcome(in->actual);
    if (outcome && in->actual_skull)
        return err_set(e, ERR_USAGE, "%s is an outcome and has its own skull: leave --actual-skull out", in->actual);
    return (outcome ? load_actual_outcome(in, c, skin, e)
                    : mesh_read_surface(in->actual, MESH_SPACE_FROM_FILE, skin, NULL, e)) &&
           (!in->actual_skull ||
            mesh_read_surface(in->actual_skull, MESH_SPACE_FROM_FILE, &c->actual_cranium, NULL, e)) &&
           (!in->actual_landmarks || landmarks_read(in->actual_landmarks, &c->actual_points, NULL, e));
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

static bool measure(face_compare *c, surface *actual, compare_align how, err *e)
{
    if (!face_compare_align(how, c, actual, e)) return false;
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
    if (in->align == ALIGN_BONE && !(outcome && (is_outcome(in->actual) || in->actual_skull)))
        return err_set(
            e, ERR_USAGE,
            "the faces cannot be aligned on bone: it needs an outcome as prediction, and as actual face another "
            "one or a mesh with its skull (--actual-skull)");
    bool ok = (outcome ? load_outcome(in->predicted, &c, e) : load_mesh(in, &c, e)) &&
              load_actual(in, &c, &actual, e) && measure(&c, &actual, in->align, e);
    surface_free(&actual);
    if (ok)
        *out = c;
    else
        face_compare_free(&c);
    return ok;
}
