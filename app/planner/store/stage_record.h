/* stage_record: what a stage took, as records tell it. */
#pragma once
#include "app/planner/store/record.h"
#include "geometry/clock.h"

extern const record_table stage_table;
/* A member that is a clock_span. */
#define ROW_STAGE(type, member, name_, help_)                                                                          \
    {                                                                                                                  \
        .kind = RECORD_OBJECT, .offset = offsetof(type, member), .table = &stage_table, .name = "stages." name_,       \
        .help = help_                                                                                                  \
    }
