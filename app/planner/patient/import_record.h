/* import_record: what gnathos import prints with --json. */
#pragma once
#include "app/planner/patient/import.h"
#include "app/planner/store/record.h"

extern const record_table import_record_table; /* kind "import" */
json_t *import_record_json(const import_result *r, const char *folder, const issue_list *notes);
