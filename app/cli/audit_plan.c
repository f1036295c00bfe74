/* gnathos audit CASE --plan P: one plan by all limits. */
#include "app/cli/audit_plan.h"
#include "app/planner/store/output_dir.h"
#include "app/cli/plan_audit_print.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/worst_places.h"
#endif
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

/* audit.json and, where this build draws, worst_places.png. */
static bool write_all(const judge *j, const plan_audit *a, const plan_moves *moves, const output_dir *dir, err *e)
{
    char *path = output_dir_file(dir, "audit.json");
    json_t *record = plan_audit_json(a);
    bool ok = json_file_write(record, path, e);
    json_decref(record);
    free(path);
#if GNATHOS_WITH_RENDER
    char title[FIELD_TEXT_SIZE * 2 + 16];
    snprintf(title, sizeof title, "%s: %s", a->patient->name, a->plan->name);
    path = output_dir_file(dir, "worst_places.png");
    ok = ok && judge_picture_write(j, moves, &a->judgement, title, path, e);
    free(path);
#else
    (void)j;
    (void)moves;
#endif
    return ok;
}

static bool judge_it(const audit_plan_options *in, const case_file *c, const prepared *p, const plan_file *plan,
                     const plan_moves *moves, output_dir *dir, int *status, err *e)
{
    judge *j;
    if (!judge_create(c, p, &j, e)) return false;
    plan_audit *a = NEW_ARRAY(plan_audit, 1);
    plan_audit_make(j, c, p, plan, moves, a);
    bool ok = !in->out || (write_all(j, a, moves, dir, e) && output_dir_close(dir, e));
    judge_free(&j);
    if (ok && in->common.json)
        command_print_json(plan_audit_json(a), "audit-plan");
    else if (ok)
        plan_audit_print(a);
    if (plan_audit_infeasible(a)) *status = ERR_INFEASIBLE;
    free(a);
    return ok;
}

int command_audit_plan(const audit_plan_options *in)
{
    err e = {0};
    case_file c;
    landmarks points = {0};
    plan_file plan;
    plan_moves moves;
    prepared p = {0};
    const task watch = command_task(&in->common);
    issue_list issues = {0};
    output_dir dir = {0};
    int status = 0;
    bool ok = case_file_load(in->case_path, &c, &e) && landmarks_read(c.landmarks, &points, NULL, &e);
    if (ok) {
        ok = plan_file_read(in->plan, &c, &plan, &issues) && plan_moves_set(&plan, &c, &points, &moves, &issues);
        ok = issue_none_is_error(&issues, &e) && ok;
    }
    ok = ok && (!in->out || output_dir_open(in->out, in->force, &dir, &e)) &&
         prepared_get(&c, in->cache, &watch, &p, &e) && judge_it(in, &c, &p, &plan, &moves, &dir, &status, &e);
    if (!ok && in->out) output_dir_abandon(&dir);
    prepared_free(&p);
    landmarks_free(&points);
    issue_list_free(&issues);
    return ok ? status : command_fail(&e);
}
