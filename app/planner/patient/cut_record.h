/* cut_record: repair and cuts of the bones in numbers; what gnathos cut writes of them. */
#pragma once
#include "app/planner/patient/anatomy.h"
#include "app/planner/store/record.h"

extern const record_table repair_table; /* of a repair_report */
extern const record_table cuts_table;   /* of a cut_report */

extern const record_table cut_record_table; /* kind "cut": cut_report.json */
json_t *cut_record_json(const case_file *c, const anatomy *a);
