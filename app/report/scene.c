#include "app/report/scene.h"
#include "app/planner/store/content_hash.h"
#include "app/planner/store/record.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "render/colormap.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double position_step_mm = 0.005, displacement_step_mm = 0.001;

static const landmark_row *known(const char *label) { return label ? landmark_row_find(label) : NULL; }

bool report_record_check(const json_file *f, err *e)
{
    static const char *const shown[] = {"plan",      "scene", "material", "solve",     "prepared",     "seconds",
                                        "movements", "trust", "limits",   "landmarks", "soft_to_hard", "cephalometry"};
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        if (!json_object_get(f->root, shown[i]))
            return json_file_refuse(f, "", e, "lacks \"%s\": another version of gnathos wrote it; predict again",
                                    shown[i]);
    return true;
}

static void withhold(json_t *object, const char *key, const char *name, json_t *withheld)
{
    const char *text = json_string_value(json_object_get(object, key));
    if (text && *text) json_array_append_new(withheld, json_string(name));
    json_object_del(object, key);
}

json_t *report_record(const json_t *root, bool names)
{
    json_t *out = json_deep_copy(root), *withheld = json_array();
    json_t *list = json_object_get(out, "landmarks"), *plan = json_object_get(out, "plan");
    if (!names) {
        withhold(out, "case", "name of the case", withheld);
        withhold(plan, "name", "name of the plan", withheld);
        withhold(plan, "override", "reason why the plan may leave its bounds", withheld);
        json_object_del(json_object_get(out, "limits"), "override");
        size_t before = json_array_size(list);
        for (size_t i = before; i-- > 0;)
            if (!known(json_string_value(json_object_get(json_array_get(list, i), "label"))))
                json_array_remove(list, i);
        if (json_array_size(list) < before)
            json_array_append_new(withheld, json_string("landmarks with labels of the user's own"));
    }
    json_object_set_new(out, "withheld", withheld);
    return out;
}

static bool same_text(const json_file *f, const char *key, const json_t *own, err *e)
{
    const char *text = json_string_value(json_object_get(f->root, key)), *want = json_string_value(own);
    char pointer[32];
    if (!text || !want || !strcmp(text, want)) return true;
    snprintf(pointer, sizeof pointer, "/%s", key);
    return json_file_refuse(f, pointer, e, "is \"%s\", must be \"%s\" as in the outcome", text, want);
}

bool report_audit(const json_file *audit, const json_t *outcome, bool names, json_t **out, err *e)
{
    static const char *const own_text[] = {"case", "plan", "override"};
    const char *kind = strcmp(record_kind_of(audit->root), "plan_audit") ? "audit" : "plan_audit";
    if (!record_check(audit, kind, e)) return false;
    if (!same_text(audit, "case", json_object_get(outcome, "case"), e) ||
        !same_text(audit, "plan", json_object_get(json_object_get(outcome, "plan"), "name"), e) ||
        !same_text(audit, "hash", json_object_get(outcome, "case_hash"), e))
        return false;
    *out = json_deep_copy(audit->root);
    for (size_t i = 0; !names && i < sizeof own_text / sizeof *own_text; i++) json_object_del(*out, own_text[i]);
    return true;
}

static void add_rounded(packed *out, const double *mm, size_t count, double step)
{
    int32_t *whole = NEW_ARRAY(int32_t, count);
    for (size_t i = 0; i < count; i++) whole[i] = (int32_t)lround(mm[i] / step);
    packed_add(out, whole, count, 3);
    free(whole);
}

static void add_colours(packed *out, const surface *s)
{
    size_t n = 3 * (size_t)s->vertex_count;
    int32_t *whole = NEW_ARRAY(int32_t, n);
    for (size_t i = 0; i < n; i++) whole[i] = s->rgb[i];
    packed_add(out, whole, n, 3);
    free(whole);
}

/* planned may be NULL. The triangles come last. */
static json_t *add_shape(const char *name, const surface *s, const double *planned, packed *out)
{
    size_t n = 3 * (size_t)s->vertex_count;
    add_rounded(out, s->xyz, n, position_step_mm);
    if (planned) {
        double *u = NEW_ARRAY(double, n);
        for (size_t i = 0; i < n; i++) u[i] = planned[i] - s->xyz[i];
        add_rounded(out, u, n, displacement_step_mm);
        free(u);
    }
    if (s->rgb) add_colours(out, s);
    packed_add(out, s->tri, 3 * (size_t)s->triangle_count, 3);
    return json_pack("{ss si si sb sb}", "name", name, "vertices", (int)s->vertex_count, "triangles",
                     (int)s->triangle_count, "moves", planned != NULL, "colours", s->rgb != NULL);
}

static json_t *matrix_json(const rigid *move)
{
    double m[16];
    rigid_to_matrix(move, m);
    json_t *out = json_array();
    for (int i = 0; i < 16; i++) json_array_append_new(out, json_real(m[i]));
    return out;
}

static json_t *vector_json(const double v[3]) { return json_pack("[fff]", v[0], v[1], v[2]); }

static json_t *map_json(colormap map)
{
    char *text = base64_text(colormap_table(map), 3 * COLORMAP_SIZE);
    json_t *out = json_string(text);
    free(text);
    return out;
}

/* End of the scale of displacements. */
static double heat_high_mm(const surface *a, const surface *b)
{
    double most = 0;
    for (int32_t v = 0; v < a->vertex_count; v++)
        most = fmax(most, vec_distance(a->xyz + 3 * (size_t)v, b->xyz + 3 * (size_t)v));
    return colormap_nice_ceiling(most > 1e-3 ? most : 1);
}

json_t *report_scene(const outcome_shapes *o, packed *out)
{
    json_t *shapes = json_array(), *help = json_object();
    json_array_append_new(shapes, add_shape("skin", &o->skin_before, o->skin_after.xyz, out));
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        const surface *bone = &o->at_rest.part[s];
        double rgb[3];
        if (!bone->triangle_count) continue;
        json_t *shape = add_shape(segment_name((segment_id)s), bone, NULL, out);
        segment_color((segment_id)s, rgb);
        json_object_set_new(shape, "rgb", vector_json(rgb));
        json_object_set_new(shape, "matrix", matrix_json(&o->move[s]));
        json_array_append_new(shapes, shape);
    }
    for (int32_t i = 0; i < o->record.before.count; i++) {
        const landmark_row *row = known(o->record.before.point[i].label);
        if (row) json_object_set_new(help, row->label, json_string(row->help));
    }
    char hash[HASH_TEXT_SIZE];
    content_hash *h = content_hash_start();
    content_hash_bytes(h, o->record.file.text, strlen(o->record.file.text));
    content_hash_end(h, hash);
    const head_frame *f = &o->record.frame;
    return json_pack("{sf sf sf sf s{so so so} s{so so} so so ss ss}", "step_mm", position_step_mm,
                     "displacement_step_mm", displacement_step_mm, "largest_error_mm",
                     (position_step_mm + displacement_step_mm) / 2 * sqrt(3), "heat_high_mm",
                     heat_high_mm(&o->skin_before, &o->skin_after), "frame", "left", vector_json(f->left), "posterior",
                     vector_json(f->posterior), "up", vector_json(f->up), "maps", "viridis", map_json(COLORMAP_VIRIDIS),
                     "coolwarm", map_json(COLORMAP_COOLWARM), "shapes", shapes, "landmark_help", help, "outcome_sha256",
                     hash, "version", GNATHOS_VERSION);
}
