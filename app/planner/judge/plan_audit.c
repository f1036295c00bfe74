#include "app/planner/judge/plan_audit.h"
#include <math.h>

void plan_audit_make(const judge *j, const case_file *c, const prepared *p, const plan_file *plan,
                     const plan_moves *moves, plan_audit *out)
{
    *out = (plan_audit){.patient = c, .plan = plan};
    judge_plan(j, moves, &out->judgement);
    for (int i = 0; i < out->judgement.count; i++) {
        const finding *f = &out->judgement.finding[i];
        bool of_the_cuts = f->limit >= LIMIT_ROOT_CLEARANCE && f->limit <= LIMIT_CUT_MARGIN;
        if (f->level >= LIMIT_CAUTION && !of_the_cuts)
            (void)remedy_find(j, c, p, plan, &out->judgement, i, out->remedy[i]);
    }
}

bool plan_audit_infeasible(const plan_audit *a) { return a->judgement.worst == LIMIT_STOP && !*a->plan->override; }

static json_t *number(double v) { return isfinite(v) ? json_real(v) : json_null(); }

static json_t *range_json(const double r[2]) { return json_pack("[oo]", number(r[0]), number(r[1])); }

static json_t *finding_json(const finding *f, const case_file *c)
{
    const limit *l = &limit_default[f->limit];
    const limit_range *r = &c->limits[f->limit];
    json_t *o = json_pack("{ss ss ss ss so so so so sb ss}", "limit", l->name, "where", f->where, "what", l->what,
                          "level", limit_level_name(f->level), "value", number(f->value), "fine", range_json(r->fine),
                          "stop", range_json(r->stop), "margin", number(f->margin), "estimated", f->estimated, "source",
                          c->limit_from_case[f->limit] ? "set by the case" : l->source);
    if (*l->unit) json_object_set_new(o, "unit", json_string(l->unit));
    if (f->has_place) json_object_set_new(o, "place_lps_mm", json_pack("[fff]", f->place[0], f->place[1], f->place[2]));
    if (f->segment_a >= 0) json_object_set_new(o, "segment", json_string(segment_name((segment_id)f->segment_a)));
    if (f->segment_b >= 0) json_object_set_new(o, "other_segment", json_string(segment_name((segment_id)f->segment_b)));
    if (f->note) json_object_set_new(o, "note", json_string(f->note));
    return o;
}

json_t *judgement_json(const judgement *j, const case_file *c, const char *override)
{
    json_t *list = json_array();
    for (int i = 0; i < j->count; i++) json_array_append_new(list, finding_json(&j->finding[i], c));
    json_t *o = json_pack("{ss ss so}", "worst", limit_level_name(j->worst), "override", override, "limits", list);
    if (j->reason >= 0) json_object_set_new(o, "decides", json_string(limit_default[j->finding[j->reason].limit].name));
    return o;
}

json_t *plan_audit_json(const plan_audit *a)
{
    json_t *o = judgement_json(&a->judgement, a->patient, a->plan->override), *list = json_object_get(o, "limits");
    for (int i = 0; i < a->judgement.count; i++)
        if (*a->remedy[i]) json_object_set_new(json_array_get(list, (size_t)i), "remedy", json_string(a->remedy[i]));
    json_object_set_new(o, "case", json_string(a->patient->name));
    json_object_set_new(o, "plan", json_string(a->plan->name));
    json_object_set_new(o, "feasible", json_boolean(!plan_audit_infeasible(a)));
    return o;
}

bool judgement_allows(const judgement *j, const case_file *c, const plan_file *plan, err *e)
{
    if (j->worst != LIMIT_STOP || *plan->override) return true;
    const finding *f = &j->finding[j->reason];
    const limit *l = &limit_default[f->limit];
    char stop[LIMIT_WORDS_SIZE];
    return err_at(
        e, ERR_INFEASIBLE, plan->path, 0, NULL,
        "%s%s%s is %.4g, must be %s: %s. Change the plan (gnathos audit CASE --plan names what would help), or "
        "say why in \"override\"",
        l->name, *f->where ? ", " : "", f->where, f->value, limit_range_words(c->limits[f->limit].stop, stop),
        c->limit_from_case[f->limit] ? "set by the case" : l->source);
}
