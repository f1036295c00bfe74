#include "app/planner/judge/plan_audit.h"
#include <stdio.h>
#include <string.h>

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

/* "3 to 6", "at least 5", "at most 3", "-". */
static const char *range_words(const double r[2], char text[48])
{
    bool low = r[0] > -LIMIT_OPEN, high = r[1] < LIMIT_OPEN;
    if (low && high)
        snprintf(text, 48, "%g to %g", r[0], r[1]);
    else if (low || high)
        snprintf(text, 48, "at %s %g", low ? "least" : "most", low ? r[0] : r[1]);
    else
        snprintf(text, 48, "-");
    return text;
}

static void print_finding(const plan_audit *a, const finding *f, const char *remedy)
{
    const limit *l = &limit_default[f->limit];
    const limit_range *r = &a->patient->limits[f->limit];
    char name[80], fine[48], stop[48], margin[24] = "-";
    snprintf(name, sizeof name, "%s%s%s", l->name, *f->where ? ", " : "", f->where);
    if (f->level == LIMIT_NOT_JUDGED) {
        printf("%-10s %-56s %s\n", limit_level_name(f->level), name, f->note);
        return;
    }
    if (isfinite(f->margin)) snprintf(margin, sizeof margin, "%.2f", f->margin);
    printf("%-10s %-56s %8.2f  %-14s %-14s %8s%s%s%s\n", limit_level_name(f->level), name, f->value,
           range_words(r->fine, fine), range_words(r->stop, stop), margin, f->estimated ? "  estimated" : "",
           *remedy ? "  -> " : "", remedy);
}

void plan_audit_print(const plan_audit *a)
{
    const judgement *j = &a->judgement;
    int count[4] = {0};
    for (int i = 0; i < j->count; i++) count[j->finding[i].level]++;
    printf("plan %s on %s: %d stop, %d caution, %d fine, %d not judged\n\n", a->plan->name, a->patient->name,
           count[LIMIT_STOP], count[LIMIT_CAUTION], count[LIMIT_FINE], count[LIMIT_NOT_JUDGED]);
    printf("%-10s %-56s %8s  %-14s %-14s %8s\n", "level", "limit", "value", "fine", "stop outside", "margin");
    static const limit_level order[] = {LIMIT_STOP, LIMIT_CAUTION, LIMIT_FINE, LIMIT_NOT_JUDGED};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < j->count; i++)
            if (j->finding[i].level == order[k]) print_finding(a, &j->finding[i], a->remedy[i]);
    printf(
        "\nThe soft tissue (stretch, incisor show, proportions) is judged by gnathos predict. ->: the smallest single "
        "change of the plan that brings the limit to the next better level and none to a worse one.\n");
    if (j->worst != LIMIT_STOP) return;
    if (*a->plan->override)
        printf("Stops accepted because: %s\n", a->plan->override);
    else
        printf("Not feasible as it stands. Change the plan, or say why in \"override\".\n");
}

static json_t *number(double v) { return isfinite(v) ? json_real(v) : json_null(); }

static json_t *range_json(const double r[2])
{
    return json_pack("[oo]", r[0] > -LIMIT_OPEN ? json_real(r[0]) : json_null(),
                     r[1] < LIMIT_OPEN ? json_real(r[1]) : json_null());
}

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

void judgement_print_brief(const judgement *j, const case_file *c)
{
    int count[4] = {0};
    char stop[48];
    for (int i = 0; i < j->count; i++) count[j->finding[i].level]++;
    printf("limits: %d stop, %d caution, %d not judged (gnathos audit CASE --plan lists them)\n", count[LIMIT_STOP],
           count[LIMIT_CAUTION], count[LIMIT_NOT_JUDGED]);
    for (int i = 0; i < j->count; i++) {
        const finding *f = &j->finding[i];
        if (f->level == LIMIT_STOP)
            printf("  %s%s%s is %.4g, should be %s\n", limit_default[f->limit].name, *f->where ? ", " : "", f->where,
                   f->value, range_words(c->limits[f->limit].stop, stop));
    }
}

bool judgement_allows(const judgement *j, const case_file *c, const plan_file *plan, err *e)
{
    if (j->worst != LIMIT_STOP || *plan->override) return true;
    const finding *f = &j->finding[j->reason];
    const limit *l = &limit_default[f->limit];
    char stop[48];
    return err_at(
        e, ERR_INFEASIBLE, plan->path, 0, NULL,
        "%s%s%s is %.4g, must be %s: %s. Change the plan (gnathos audit CASE --plan names what would help), or "
        "say why in \"override\"",
        l->name, *f->where ? ", " : "", f->where, f->value, range_words(c->limits[f->limit].stop, stop),
        c->limit_from_case[f->limit] ? "set by the case" : l->source);
}
