#include "app/planner/plan/plan_json.h"
#include "app/planner/store/record.h"

static json_t *numbers(const double *x, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++) json_array_append_new(list, json_real(x[i]));
    return list;
}

static json_t *segment_json(const plan_segment *s)
{
    const segment_move *m = &s->move;
    json_t *out = json_object();
    double matrix[16];
    if (m->kind == MOVE_RIGID) {
        rigid_to_matrix(&m->motion, matrix);
        json_object_set_new(out, "matrix", numbers(matrix, 16));
        return out;
    }
    json_object_set_new(out, "translate_mm", numbers(m->translate_mm, 3));
    const double angle[] = {m->pitch_deg, m->yaw_deg, m->roll_deg};
    static const char *const name[] = {"pitch_deg", "yaw_deg", "roll_deg"};
    for (int k = 0; k < 3; k++)
        if (angle[k] != 0) json_object_set_new(out, name[k], json_real(angle[k]));
    if (s->has_pivot_point)
        json_object_set_new(out, "pivot", numbers(m->pivot_mm, 3));
    else if (*s->pivot)
        json_object_set_new(out, "pivot", json_string(s->pivot));
    return out;
}

json_t *plan_json(const plan_file *p, const char *name)
{
    json_t *moves = json_object();
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (p->segment[s].move.kind != MOVE_NONE)
            json_object_set_new(moves, segment_name((segment_id)s), segment_json(&p->segment[s]));
    json_t *out = json_pack("{si ss so}", "gnathos", RECORD_FORMAT, "name", name, "segments", moves);
    if (p->load_steps != plan_file_default().load_steps)
        json_object_set_new(out, "load_steps", json_integer(p->load_steps));
    return out;
}
