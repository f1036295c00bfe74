/* landmarks_record: what gnathos landmarks prints with --json. */
#pragma once
#include "app/planner/identity/head_landmarks.h"
#include "app/planner/store/record.h"

typedef struct landmarks_record {
    const char *path;
    double most_mm;
    const head_landmarks *found;
} landmarks_record;
extern const record_table landmarks_record_table; /* kind "landmarks" */
