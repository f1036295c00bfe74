/* gnathos audit CASE --plan P: one plan by all limits. */
#include "app/cli/audit.h"
#include "app/cli/plan_audit_print.h"
#include "app/planner/judge/judgement_record.h"
#if GNATHOS_WITH_RENDER
#include "app/pictures/worst_places.h"
#endif
#include "app/planner/plan/plan_json.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

static bool write_remedy(const plan_audit *a, const output_dir *dir, err *e)
{
    if (!a->remedy.found) return true;
    char name[FIELD_TEXT_SIZE], *path = output_dir_file(dir, "remedy.json");
    snprintf(name, sizeof name, "%.200s, remedy", a->plan->name);
    json_t *plan = plan_json(&a->remedy.plan, name);
    bool ok = json_file_write(plan, path, e);
    json_decref(plan);
    free(path);
    return ok;
}

/* audit.json, remedy.json where there is one and, where this build draws, worst_places.png. */
static bool write_all(const judge *j, const plan_audit *a, const json_t *record, const plan_moves *moves,
                      const output_dir *dir, err *e)
{
    char *path = output_dir_file(dir, "audit.json");
    bool ok = json_file_write(record, path, e);
    free(path);
    ok = ok && write_remedy(a, dir, e);
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

bool audit_plan_run(run_context *r, err *e)
{
    judge *j;
    if (!judge_create(&r->patient, &r->prepared, &j, e)) return false;
    plan_audit *a = NEW_ARRAY(plan_audit, 1);
    plan_audit_make(j, &r->patient, &r->prepared, &r->plan, &r->moves, a);
    json_t *record = plan_audit_json(a);
    bool ok = !r->out_path || (write_all(j, a, record, &r->moves, &r->dir, e) && output_dir_close(&r->dir, e));
    judge_free(&j);
    if (ok && r->common.json)
        command_print_record(json_incref(record));
    else if (ok)
        plan_audit_print(a);
    if (plan_audit_infeasible(a)) r->status = ERR_INFEASIBLE;
    json_decref(record);
    free(a);
    return ok;
}
