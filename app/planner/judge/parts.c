/* Where a plan puts points and bones. */
#include "app/planner/judge/parts.h"
#include "geometry/vec.h"

bool judge_landmark(const judge *j, const plan_moves *m, const char *label, double out[3])
{
    const landmarks *l = &j->prepared->points;
    const landmark *p = landmarks_find(l, label);
    if (!p) return false;
    rigid_apply(&m->move[j->carrier[p - l->point]], p->xyz, out);
    return true;
}

bool judge_relative(const plan_moves *m, segment_id still, segment_id moved, rigid *out)
{
    rigid back = rigid_inverse(&m->move[still]);
    *out = rigid_compose(&back, &m->move[moved]);
    return vec_norm(out->t) > 1e-9 || rigid_angle(out) > 1e-9;
}
