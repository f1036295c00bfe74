/* plan_audit: one plan judged by all limits. */
#pragma once
#include "app/planner/judge/judge.h"
#include "app/planner/judge/remedy.h"

typedef struct plan_audit {
    const case_file *patient;
    const plan_file *plan;
    judgement judgement;
    remedy remedy;
} plan_audit;

/* Judges, and looks for a remedy of a plan that is stopped. */
void plan_audit_make(const judge *j, const case_file *c, const prepared *p, const plan_file *plan,
                     const plan_moves *moves, plan_audit *out);
/* A stop without an override. */
bool plan_audit_infeasible(const plan_audit *a);
/* True unless a finding stops the plan and it has no override; then e names the first one (ERR_INFEASIBLE). */
bool judgement_allows(const judgement *j, const case_file *c, const plan_file *plan, err *e) MUST_CHECK;
