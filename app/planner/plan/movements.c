#include "app/planner/plan/movements.h"
#include "app/planner/plan/plan_moves.h"
#include "geometry/vec.h"

static movement movement_of(segment_id s, const rigid *move, const landmarks *before, const head_frame *f)
{
    const landmark *at = plan_moves_reference(before, s);
    movement m = {.segment = s, .left_mm = (double)NAN, .anterior_mm = (double)NAN, .up_mm = (double)NAN};
    double d[3];
    if (at) {
        rigid_apply(move, at->xyz, d);
        vec_sub(d, at->xyz, d);
        m.at = at->label;
        m.left_mm = vec_dot(d, f->left);
        m.anterior_mm = -vec_dot(d, f->posterior);
        m.up_mm = vec_dot(d, f->up);
    }
    rig_angles(move, f, &m.pitch_deg, &m.yaw_deg, &m.roll_deg);
    return m;
}

int movements_make(const rigid move[SEGMENT_COUNT], const landmarks *before, const head_frame *frame,
                   movement out[SEGMENT_COUNT])
{
    int count = 0;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (!rigid_is_identity(&move[s])) out[count++] = movement_of((segment_id)s, &move[s], before, frame);
    return count;
}

static const record_row movement_row[] = {
    ROW_WORD(movement, segment, "segment", SEGMENT_WORDS, "the bone"),
    {RECORD_AT(movement, at), .name = "at", .or_null = true, .help = "the landmark on it whose way is told"},
    ROW(movement, left_mm, "left_mm", "mm", "to the patient's left"),
    ROW(movement, anterior_mm, "anterior_mm", "mm", "forwards"),
    ROW(movement, up_mm, "up_mm", "mm", "upwards"),
    ROW(movement, pitch_deg, "pitch_deg", "degrees", "front end down"),
    ROW(movement, yaw_deg, "yaw_deg", "degrees", "front end to the left"),
    ROW(movement, roll_deg, "roll_deg", "degrees", "left side down"),
};
const record_table movement_table = {.title = "Move of a segment", RECORD_ROWS(movement_row)};
