/* check_record: what gnathos check prints with --json. */
#pragma once
#include "app/planner/patient/check.h"
#include "app/planner/store/record.h"

extern const record_table issue_table;        /* of an issue */
extern const record_table check_record_table; /* kind "check" */
/* plan: the path of the plan that was checked too, or NULL. */
json_t *check_record_json(const case_file *c, const check_found *found, const char *plan, const issue_list *issues);
