/* judge: a plan against the limits of bone, teeth and nerve, in milliseconds and without a solve. */
#pragma once
#include "app/planner/judge/judgement.h"
#include "app/planner/patient/prepared.h"
#include "app/planner/plan/plan_moves.h"

/* Everything that does not depend on the plan. */
typedef struct judge judge;

/* Borrows c and p until judge_free. */
bool judge_create(const case_file *c, const prepared *p, judge **out, err *e) MUST_CHECK;
void judge_free(judge **j); /* idempotent */

/* All limits but those of the tissue. const and thread-safe; same bits for any number of threads. Findings come in the
 * order of the limits, whatever the plan. */
void judge_plan(const judge *j, const plan_moves *m, judgement *out);
