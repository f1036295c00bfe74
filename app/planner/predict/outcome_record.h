/* outcome_record: outcome.json, all numbers that are shown to a user. */
#pragma once
#include "app/planner/predict/outcome.h"
#include "app/planner/store/record.h"

extern const record_table outcome_table; /* kind "outcome" */
/* A new object. */
json_t *outcome_json(const outcome *o);
