/* gnathos audit CASE --plan P: one plan by all limits. */
#include "app/command_audit_plan.h"
#include "app/plan_audit.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

static void show_progress(const char *stage, double fraction, void *context)
{
    command_progress_at(context, stage, fraction);
}

static bool judge_it(const audit_plan_options *in, const case_file *c, const prepared *p, const plan_file *plan,
                     const plan_moves *moves, int *status, err *e)
{
    judge *j;
    if (!judge_create(c, p, &j, e)) return false;
    plan_audit *a = NEW_ARRAY(plan_audit, 1);
    plan_audit_make(j, c, p, plan, moves, a);
    judge_free(&j);
    if (in->common.json)
        command_print_json(plan_audit_json(a), "audit-plan");
    else
        plan_audit_print(a);
    if (plan_audit_infeasible(a)) *status = ERR_INFEASIBLE;
    free(a);
    return true;
}

int command_audit_plan(const audit_plan_options *in)
{
    err e = {0};
    case_file c;
    landmarks points = {0};
    plan_file plan;
    plan_moves moves;
    prepared p = {0};
    issue_list issues = {0};
    int status = 0;
    bool ok = case_file_load(in->case_path, &c, &e) && landmarks_read(c.landmarks, &points, NULL, &e);
    if (ok) {
        ok = plan_file_read(in->plan, &c, &plan, &issues) && plan_moves_set(&plan, &c, &points, &moves, &issues);
        ok = issue_none_is_error(&issues, &e) && ok;
    }
    ok = ok && prepared_get(&c, in->cache, show_progress, (void *)&in->common, &p, &e) &&
         judge_it(in, &c, &p, &plan, &moves, &status, &e);
    prepared_free(&p);
    landmarks_free(&points);
    issue_list_free(&issues);
    return ok ? status : command_fail(&e);
}
