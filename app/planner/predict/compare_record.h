/* compare_record: comparison.json of gnathos compare. */
#pragma once
#include "app/planner/predict/face_compare.h"
#include "app/planner/store/record.h"

extern const record_table comparison_table; /* kind "comparison" */
json_t *face_compare_json(const face_compare_input *in, const face_compare *c);
