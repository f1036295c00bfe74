/* prepared_report: repair, cuts and tissue mesh of a case in numbers, and what is doubtful about it. */
#pragma once
#include "app/planner/patient/prepared.h"
#include "app/planner/store/record.h"

extern const record_table prepared_report_table; /* of what prepared_report writes */
/* A new object. */
json_t *prepared_report(const case_file *c, const anatomy *a, const tissue_report *r);
/* The warnings of a case that is prepared, to be told as gnathos check tells them. The caller frees the list. */
issue_list prepared_warnings(const prepared *p, const case_file *c);

extern const record_table prepared_record_table; /* kind "prepared": what gnathos prepare prints */
json_t *prepared_record_json(const prepared *p);
