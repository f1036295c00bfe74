/* made_record: what verbs that make files print of them with --json. */
#pragma once
#include "app/planner/store/record.h"

typedef struct made_record {
    const char *verb;
    const json_t *files; /* a list of paths */
    int64_t bytes;       /* of the one file; 0: not told */
    bool timed;
    double load_s, draw_s, draw_cpu_s; /* where timed */
} made_record;
extern const record_table made_record_table; /* kind "files" */
