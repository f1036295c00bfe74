#include "app/planner/plan/movements.h"
#include "app/planner/plan/plan_moves.h"
#include "geometry/vec.h"

static json_t *row(segment_id s, const rigid *move, const landmarks *before, const head_frame *f)
{
    const landmark *at = plan_moves_reference(before, s);
    json_t *out = json_pack("{ss ss?}", "segment", segment_name(s), "at", at ? at->label : NULL);
    static const char *const name[] = {"left_mm", "anterior_mm", "up_mm"};
    double d[3] = {0}, pitch, yaw, roll;
    if (at) {
        rigid_apply(move, at->xyz, d);
        vec_sub(d, at->xyz, d);
    }
    const double along[] = {vec_dot(d, f->left), -vec_dot(d, f->posterior), vec_dot(d, f->up)};
    for (int k = 0; k < 3; k++) json_object_set_new(out, name[k], at ? json_real(along[k]) : json_null());
    rig_angles(move, f, &pitch, &yaw, &roll);
    json_object_set_new(out, "pitch_deg", json_real(pitch));
    json_object_set_new(out, "yaw_deg", json_real(yaw));
    json_object_set_new(out, "roll_deg", json_real(roll));
    return out;
}

json_t *movements_json(const rigid move[SEGMENT_COUNT], const landmarks *before, const head_frame *frame)
{
    json_t *list = json_array();
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (!rigid_is_identity(&move[s])) json_array_append_new(list, row((segment_id)s, &move[s], before, frame));
    return list;
}
