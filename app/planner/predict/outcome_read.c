#include "app/planner/predict/outcome_read.h"
#include "app/planner/store/record.h"
#include "geometry/mesh_file.h"
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_SIZE = 4096 };

bool is_outcome(const char *folder)
{
    char path[PATH_SIZE];
    struct stat there;
    snprintf(path, sizeof path, "%s/outcome.json", folder);
    return !stat(path, &there);
}

void outcome_record_free(outcome_record *r)
{
    json_file_free(&r->file);
    landmarks_free(&r->before);
    landmarks_free(&r->after);
}

static bool read_points(outcome_record *r, err *e)
{
    size_t i;
    json_t *item;
    const json_t *list = json_object_get(r->file.root, "landmarks");
    if (!json_array_size(list)) return json_file_refuse(&r->file, "/landmarks", e, "this outcome has no landmarks");
    json_array_foreach(list, i, item)
    {
        char pointer[64];
        double p[3];
        const char *label = json_string_value(json_object_get(item, "label"));
        snprintf(pointer, sizeof pointer, "/landmarks/%zu", i);
        if (!label || !*label || json_string_length(json_object_get(item, "label")) >= LANDMARK_LABEL_SIZE)
            return json_file_refuse(&r->file, pointer, e, "a landmark needs a label of 1 to 31 bytes");
        snprintf(pointer, sizeof pointer, "/landmarks/%zu/before_lps_mm", i);
        if (!json_file_vec3(&r->file, json_object_get(item, "before_lps_mm"), pointer, p, e)) return false;
        landmarks_set(&r->before, label, p);
        snprintf(pointer, sizeof pointer, "/landmarks/%zu/after_lps_mm", i);
        if (!json_file_vec3(&r->file, json_object_get(item, "after_lps_mm"), pointer, p, e)) return false;
        landmarks_set(&r->after, label, p);
    }
    return head_frame_from_landmarks(&r->before, &r->frame, e);
}

bool outcome_record_read(const char *folder, outcome_record *out, err *e)
{
    char path[PATH_SIZE];
    outcome_record r = {0};
    snprintf(path, sizeof path, "%s/outcome.json", folder);
    bool ok = json_file_read(path, &r.file, e) && record_check(&r.file, "outcome", e);
    if (ok && !json_is_true(json_object_get(json_object_get(r.file.root, "solve"), "solved")))
        ok = json_file_refuse(&r.file, "/solve", e, "the solve did not reach equilibrium: there is no predicted face");
    ok = ok && read_points(&r, e);
    if (ok)
        *out = r;
    else
        outcome_record_free(&r);
    return ok;
}

bool outcome_skin_read(const char *folder, bool after, surface *out, err *e)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/skin_%s.ply", folder, after ? "after" : "before");
    return mesh_read_surface(path, MESH_SPACE_FROM_FILE, out, NULL, e);
}

static bool read_segment(const char *path, const outcome_record *r, const char *name, surface *out, rigid *move, err *e)
{
    const json_t *plan = json_object_get(json_object_get(r->file.root, "plan"), "segments"),
                 *matrix = json_object_get(json_object_get(plan, name), "matrix");
    double m[16];
    if (matrix) {
        for (size_t i = 0; i < 16; i++) m[i] = json_number_value(json_array_get(matrix, i));
        if (!rigid_from_matrix(m, move, e)) return err_prefix(e, "%s: plan.segments.%s", r->file.path, name);
    }
    if (!mesh_read_surface(path, MESH_SPACE_FROM_FILE, out, NULL, e)) return false;
    rigid back = rigid_inverse(move);
    if (matrix) surface_transform(out, &back);
    return true;
}

bool outcome_segments_read(const char *folder, const outcome_record *r, segments *at_rest, rigid move[SEGMENT_COUNT],
                           err *e)
{
    segments all = {0};
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        char path[PATH_SIZE];
        struct stat there;
        const char *name = segment_name((segment_id)s);
        move[s] = rigid_identity();
        snprintf(path, sizeof path, "%s/segment_%s.ply", folder, name);
        if (stat(path, &there)) continue;
        if (read_segment(path, r, name, &all.part[s], &move[s], e)) continue;
        segments_free(&all);
        return false;
    }
    *at_rest = all;
    return true;
}

void outcome_shapes_free(outcome_shapes *s)
{
    outcome_record_free(&s->record);
    surface_free(&s->skin_before);
    surface_free(&s->skin_after);
    segments_free(&s->at_rest);
}

static bool same_triangles(const surface *a, const surface *b)
{
    return a->vertex_count == b->vertex_count && a->triangle_count == b->triangle_count &&
           !memcmp(a->tri, b->tri, 3 * (size_t)a->triangle_count * sizeof *a->tri);
}

bool outcome_shapes_read(const char *folder, outcome_shapes *out, err *e)
{
    outcome_shapes s = {0};
    bool ok = outcome_record_read(folder, &s.record, e) && outcome_skin_read(folder, false, &s.skin_before, e) &&
              outcome_skin_read(folder, true, &s.skin_after, e) &&
              outcome_segments_read(folder, &s.record, &s.at_rest, s.move, e);
    if (ok && !same_triangles(&s.skin_before, &s.skin_after))
        ok = err_at(e, ERR_INPUT, folder, 0, NULL, "skin_before.ply and skin_after.ply must have the same triangles");
    if (ok)
        *out = s;
    else
        outcome_shapes_free(&s);
    return ok;
}
