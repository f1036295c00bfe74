/* new_record: what gnathos new prints with --json. */
#pragma once
#include "app/planner/store/record.h"
#include "cases/norm_head/norm_head.h"

extern const record_table new_record_table; /* kind "new" */
json_t *new_record_json(const char *folder, const norm_head *h);
