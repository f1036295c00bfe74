/* plan_json: a plan as plan_file_read reads it. */
#pragma once
#include "app/planner/plan/plan_file.h"

/* In long form, of a plan that plan_vary_open opened: shift, angles and pivot of each piece that moves, or its matrix.
 * `name` is the plan's. A new object. */
json_t *plan_json(const plan_file *p, const char *name);
