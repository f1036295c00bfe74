#include "app/planner/planner.h"
#include "app/planner/judge/plan_audit.h"
#include "app/planner/plan/plan_vary.h"
#include "app/planner/predict/outcome_record.h"
#include <stdlib.h>

bool patient_open(const char *case_path, const char *cache, const task *watch, patient *out, err *e)
{
    *out = (patient){.options = prediction_options_default()};
    out->options.full = true;
    return case_file_load(case_path, &out->file, e) && prepared_get(&out->file, cache, watch, &out->prepared, e) &&
           judge_create(&out->file, &out->prepared, &out->judge, e) &&
           bone_shapes_make(&out->prepared, &out->shapes, e);
}

void patient_close(patient *p)
{
    live_free(&p->live);
    bone_shapes_free(&p->shapes);
    judge_free(&p->judge);
    prepared_free(&p->prepared);
    *p = (patient){0};
}

bool patient_plan_read(const patient *p, const char *path, patient_plan *out, err *e)
{
    patient_plan plan = {.file = plan_file_default()};
    if (path) {
        if (!plan_moves_load(path, &p->file, &p->prepared.points, &plan.file, &plan.moves, e)) return false;
    } else {
        for (int s = 0; s < SEGMENT_COUNT; s++) plan.moves.move[s] = rigid_identity();
    }
    judge_plan(p->judge, &plan.moves, &plan.limits);
    *out = plan;
    return true;
}

bool patient_plan_set(const patient *p, const char *control_name, double value, patient_plan *io, err *e)
{
    control x;
    patient_plan plan = *io;
    issue_list issues = {0};
    if (!control_find(control_name, &p->file, &x, e) || !plan_vary_open_for(&x, &p->prepared.frame, &plan.file, e))
        return false;
    if (!(value >= x.low && value <= x.high))
        return err_set(e, ERR_INFEASIBLE, "%s is %g, outside %g to %g %s", x.name, value, x.low, x.high, x.unit);
    plan_vary_set(&x, &p->prepared.frame, value, &plan.file);
    bool made = plan_moves_set(&plan.file, &p->file, &p->prepared.points, &plan.moves, &issues);
    bool ok = issue_none_is_error(&issues, e) && made;
    issue_list_free(&issues);
    if (!ok) return false;
    judge_plan(p->judge, &plan.moves, &plan.limits);
    *io = plan;
    return true;
}

bool patient_plan_value(const patient *p, const char *control_name, const patient_plan *plan, double *out, err *e)
{
    control x;
    plan_file opened = plan->file;
    if (!control_find(control_name, &p->file, &x, e) || !plan_vary_open_for(&x, &p->prepared.frame, &opened, e))
        return false;
    *out = plan_vary_value(&x, &p->prepared.frame, &opened);
    return true;
}

bool patient_plan_allowed(const patient *p, const patient_plan *plan, err *e)
{
    return judgement_allows(&plan->limits, &p->file, &plan->file, e);
}

bool patient_predict(patient *p, const patient_plan *plan, const task *watch, prediction *out, err *e)
{
    prediction_options options = p->options;
    if (options.load_steps == 0) options.load_steps = plan->file.load_steps;
    if (!p->live && !live_create(&p->file, &p->prepared, &p->shapes, &options, false, &p->live, e)) return false;
    return live_predict(p->live, &plan->moves, NULL, &plan->limits, watch, out, e);
}

bool patient_record(const patient *p, const patient_plan *plan, const prediction *made, const char *folder, err *e)
{
    output_dir dir;
    outcome o = outcome_of(&p->file, &p->prepared, &plan->file, &plan->moves, p->options.contact, made);
    if (!output_dir_open(folder, false, &dir, e)) return false;
    bool ok = !o.points || outcome_write_meshes(&o, &dir, e);
    if (ok) {
        char *path = output_dir_file(&dir, "outcome.json");
        json_t *record = outcome_json(&o);
        ok = json_file_write(record, path, e);
        json_decref(record);
        free(path);
    }
    ok = ok && output_dir_close(&dir, e);
    if (!ok) output_dir_abandon(&dir);
    return ok;
}
