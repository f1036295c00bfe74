/* planner: the library for another program, from a case folder to a predicted face. It prints nothing and never exits:
 * what is refused comes back as an err (geometry/err.h), what takes long is told to a task (store/task.h).
 *
 *     patient p = {0};
 *     patient_plan plan;
 *     prediction face;
 *     err e = {0};
 *     bool ok = patient_open("class3", NULL, NULL, &p, &e) && patient_plan_read(&p, "plan.json", &plan, &e) &&
 *               patient_predict(&p, &plan, NULL, &face, &e) && patient_record(&p, &plan, &face, "out", &e);
 *
 * tests/planner/two_plans.c is such a program. A patient that is open is read only but for its live prediction: plans
 * may be judged from many threads, and predicted in one at a time. */
#pragma once
#include "app/planner/judge/judge.h"
#include "app/planner/predict/live.h"

typedef struct patient {
    case_file file;
    prepared prepared;
    bone_shapes shapes;
    judge *judge;
    prediction_options options; /* patient_predict's: prediction_options_default, all tissue; to be changed before it */
    live *live;                 /* NULL until patient_predict */
} patient;

/* Reads the case and takes what is prepared from CASE/prepared, or `cache` if not NULL, or makes it (minutes).
 * Refuses what case_file_load, prepared_get, judge_create and bone_shapes_make refuse. *out points into itself and is
 * not to be moved; the caller closes it, after a refusal too. */
bool patient_open(const char *case_path, const char *cache, const task *watch, patient *out, err *e) MUST_CHECK;
void patient_close(patient *p); /* idempotent */

/* A plan with the moves it comes to and what bone and teeth say of it. */
typedef struct patient_plan {
    plan_file file;
    plan_moves moves;
    judgement limits;
} patient_plan;

/* Reads a plan, or starts from one that moves nothing (path NULL), and judges it: limits.worst says how it stands.
 * Refuses what plan_moves_load refuses. */
bool patient_plan_read(const patient *p, const char *path, patient_plan *out, err *e) MUST_CHECK;
/* Sets a control of the plan by its name ("maxilla_advance_mm", "chin_yaw_deg"; see plan/controls.h), as the case
 * bounds it, and judges again. Refuses what control_find and plan_vary_open_for refuse, and (ERR_INFEASIBLE) a value
 * beyond the bounds; *io is then as before. */
bool patient_plan_set(const patient *p, const char *control_name, double value, patient_plan *io, err *e) MUST_CHECK;
/* Of a control of the plan; as above. */
bool patient_plan_value(const patient *p, const char *control_name, const patient_plan *plan, double *out,
                        err *e) MUST_CHECK;
/* True unless a finding stops the plan and it has no override; then e names the first one (ERR_INFEASIBLE). */
bool patient_plan_allowed(const patient *p, const patient_plan *plan, err *e) MUST_CHECK;

/* The face after a plan, whatever its limits say, by a live prediction: the first one is solved from rest, the next
 * goes on from it. out->solve.outcome says whether there is a face. Refuses what live_create and live_predict refuse.
 * The caller frees *out (prediction_free) before the patient is closed. */
bool patient_predict(patient *p, const patient_plan *plan, const task *watch, prediction *out, err *e) MUST_CHECK;

/* Writes a folder as gnathos predict does, without pictures: outcome.json, meshes, landmarks. The prediction has skin,
 * landmarks and depth. Refuses (ERR_INPUT) a folder that holds something, and what output_dir_open refuses. */
bool patient_record(const patient *p, const patient_plan *plan, const prediction *made, const char *folder,
                    err *e) MUST_CHECK;
