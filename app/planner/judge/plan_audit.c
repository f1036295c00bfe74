#include "app/planner/judge/plan_audit.h"

void plan_audit_make(const judge *j, const case_file *c, const prepared *p, const plan_file *plan,
                     const plan_moves *moves, plan_audit *out)
{
    *out = (plan_audit){.patient = c, .plan = plan};
    judge_plan(j, moves, &out->judgement);
    remedy_find(j, c, p, plan, &out->judgement, &out->remedy);
}

bool plan_audit_infeasible(const plan_audit *a) { return a->judgement.worst == LIMIT_STOP && !*a->plan->override; }

bool judgement_allows(const judgement *j, const case_file *c, const plan_file *plan, err *e)
{
    if (j->worst != LIMIT_STOP || *plan->override) return true;
    const finding *f = &j->finding[j->reason];
    const limit *l = &limit_default[f->limit];
    char stop[LIMIT_WORDS_SIZE];
    return err_at(
        e, ERR_INFEASIBLE, plan->path, 0, NULL,
        "%s%s%s is %.4g, must be %s: %s. Change the plan (gnathos audit CASE --plan names the nearest one that nothing stops), or "
        "say why in \"override\"",
        l->name, *f->where ? ", " : "", f->where, f->value, limit_range_words(c->limits[f->limit].stop, stop),
        c->limit_from_case[f->limit] ? "set by the case" : l->source);
}
