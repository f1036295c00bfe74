#include "app/planner/predict/bone_shapes.h"
#include "geometry/vec.h"
#include <math.h>
#include <string.h>

static double distance(const void *context, const double x[3], double grad[3], double *hess)
{
    const bone_sight *see = context;
    distance_value v;
    distance_field_at(see->field, x, hess != NULL, &v);
    if (v.d == HUGE_VAL) return v.d;
    vec_copy(v.grad, grad);
    if (hess) memcpy(hess, v.hess, sizeof v.hess);
    return v.d;
}

static bool leave(const void *context, const double x[3], const double direction[3], double reach_mm, double hit[3],
                  double normal[3])
{
    const bone_sight *see = context;
    return distance_field_leave(see->field, x, direction, reach_mm, hit, normal);
}

static double exact(const void *context, const double x[3])
{
    const bone_sight *see = context;
    double d = nearest_point(see->tree, x, NULL, NULL);
    return nearest_inside(see->tree, x) ? -d : d;
}

bool bone_shapes_make(const prepared *p, bone_shapes *out, err *e)
{
    *out = (bone_shapes){0};
    if (!segment_trees_make(&p->segments, &p->skin, &out->trees, e)) return false;
    for (int k = 0; k < SEGMENT_COUNT; k++) {
        if (!out->trees.part[k]) continue;
        out->field[k] = bone_field_open(&p->segments.part[k], out->trees.part[k], &p->fields.part[k]);
        out->sight[k] = (bone_sight){out->field[k], out->trees.part[k]};
        out->shape[k] = (bone_shape){.context = &out->sight[k], .distance = distance, .leave = leave, .exact = exact};
    }
    rest_gap_make(&p->tissue, &out->trees, &out->gap);
    out->carriers = landmark_carriers_find(p, &out->trees);
    return true;
}

void bone_shapes_free(bone_shapes *s)
{
    for (int k = 0; k < SEGMENT_COUNT; k++) distance_field_destroy(&s->field[k]);
    rest_gap_free(&s->gap);
    segment_trees_free(&s->trees);
    landmark_carriers_free(&s->carriers);
    *s = (bone_shapes){0};
}
