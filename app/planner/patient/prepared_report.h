/* prepared_report: repair, cuts and tissue mesh of a case in numbers. */
#pragma once
#include "app/planner/patient/prepared.h"
#include "app/planner/store/record.h"

extern const record_table prepared_report_table; /* of what prepared_report writes */
/* A new object. */
json_t *prepared_report(const anatomy *a, const tissue_report *r, double bones_s, double tissue_s);

extern const record_table prepared_record_table; /* kind "prepared": what gnathos prepare prints */
json_t *prepared_record_json(const prepared *p);
