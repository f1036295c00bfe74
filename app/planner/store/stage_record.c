#include "app/planner/store/stage_record.h"

static const record_row stage_row[] = {
    ROW(clock_span, wall_s, "wall_s", "s", "wall time"),
    ROW(clock_span, cpu_s, "cpu_s", "s", "processor time of all threads"),
};
const record_table stage_table = {.title = "A stage", RECORD_ROWS(stage_row)};
