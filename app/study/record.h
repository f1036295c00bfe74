/* record: what gnathos study writes and prints for programs. */
#pragma once
#include "app/planner/store/record.h"
#include "app/study/study.h"

extern const record_table study_record_table; /* of a study, kind "study": study.json */
json_t *study_json(const study_table *t);
extern const record_table study_ratios_table; /* kind "study_ratios": ratios.json */
extern const record_table study_folder_table; /* kind "manifest": manifest.json, from the start */
json_t *study_folder_json(void);
