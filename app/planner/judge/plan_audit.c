#include "app/planner/judge/plan_audit.h"

void plan_audit_make(const judge *j, const case_file *c, const prepared *p, const plan_file *plan,
                     const plan_moves *moves, plan_audit *out)
{
    *out = (plan_audit){.patient = c, .plan = plan};
    judge_plan(j, moves, &out->judgement);
    for (int i = 0; i < out->judgement.count; i++) {
        const finding *f = &out->judgement.finding[i];
        bool of_the_case = f->limit >= LIMIT_ROOT_CLEARANCE && f->limit <= LIMIT_CASE_WARNINGS;
        if (f->level >= LIMIT_CAUTION && !of_the_case)
            (void)remedy_find(j, c, p, plan, &out->judgement, i, out->remedy[i]);
    }
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
        "%s%s%s is %.4g, must be %s: %s. Change the plan (gnathos audit CASE --plan names what would help), or "
        "say why in \"override\"",
        l->name, *f->where ? ", " : "", f->where, f->value, limit_range_words(c->limits[f->limit].stop, stop),
        c->limit_from_case[f->limit] ? "set by the case" : l->source);
}
