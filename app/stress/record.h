/* record: stress.json. */
#pragma once
#include "app/planner/store/record.h"
#include "app/stress/stress.h"

extern const record_table stress_table; /* kind "stress" */
json_t *stress_json(const stress_case *const *c, const stress_result *r, int count);
