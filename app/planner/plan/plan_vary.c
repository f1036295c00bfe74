#include "app/planner/plan/plan_vary.h"
#include <assert.h>

void plan_vary_open(plan_file *p, const head_frame *f)
{
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (p->segment[s].short_form) {
            p->segment[s].short_form = false;
            p->segment[s].move.kind = MOVE_ANGLES;
        }
    for (int i = 0; i < CONTROL_COUNT; i++) {
        if (controls[i].kind != CONTROL_OF_SEGMENT || p->value[i] == 0) continue;
        rig_move(&p->segment[controls[i].segment].move, controls[i].axis, p->value[i], f);
        p->value[i] = 0;
    }
}

bool plan_vary_open_for(const control *x, const head_frame *f, plan_file *p, err *e)
{
    plan_segment *s = &p->segment[x->segment];
    if (s->move.kind == MOVE_RIGID)
        return err_at(e, ERR_INPUT, p->path, s->line, NULL,
                      "moves the %s segment by a matrix, so that %s cannot be varied; write it with angles",
                      segment_name(x->segment), x->name);
    plan_vary_open(p, f);
    s->move.kind = MOVE_ANGLES;
    return true;
}

double plan_vary_value(const control *x, const head_frame *f, const plan_file *p)
{
    return rig_moved(&p->segment[x->segment].move, x->axis, f);
}

void plan_vary_set(const control *x, const head_frame *f, double value, plan_file *p)
{
    segment_move *m = &p->segment[x->segment].move;
    assert(m->kind == MOVE_ANGLES);
    if (x->axis >= RIG_PITCH)
        *rig_angle(m, x->axis) = value;
    else
        rig_move(m, x->axis, value - rig_moved(m, x->axis, f), f);
}
