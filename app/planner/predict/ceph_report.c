#include "app/planner/predict/ceph_report.h"
#include <math.h>

static json_t *number(double x) { return isfinite(x) ? json_real(x) : json_null(); }

static json_t *norm_json(const ceph_norm *n)
{
    return isfinite(n->mean) ? json_pack("[ff]", n->mean, n->sd) : json_null();
}

json_t *ceph_report_json(const landmarks *before, const landmarks *after, const head_frame *frame)
{
    ceph_value was[CEPH_MEASURES_MAX], is[CEPH_MEASURES_MAX];
    ceph_evaluate(before, frame, was);
    if (after) ceph_evaluate(after, frame, is);
    json_t *list = json_array();
    for (int i = 0; i < ceph_measure_count; i++) {
        const ceph_measure *m = ceph_measures + i;
        json_t *one = json_pack("{ss ss ss ss so}", "name", m->name, "group", m->group, "what", m->what, "unit",
                                m->unit, "before", number(was[i].value));
        if (after) {
            json_object_set_new(one, "planned", number(is[i].value));
            json_object_set_new(one, "change", number(is[i].value - was[i].value));
        }
        json_object_set_new(one, "norm_men", norm_json(&m->men));
        json_object_set_new(one, "norm_women", norm_json(&m->women));
        json_object_set_new(one, "source", m->source ? json_string(m->source) : json_null());
        if (*was[i].note) json_object_set_new(one, "note", json_string(was[i].note));
        json_array_append_new(list, one);
    }
    return list;
}
