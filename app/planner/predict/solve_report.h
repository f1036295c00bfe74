/* solve_report: the tables of what outcome.json says of the solve. */
#pragma once
#include "app/planner/predict/bone_depth.h"
#include "app/planner/store/record.h"
#include "sim/equilibrium.h"

extern const record_table solve_table;      /* of an equilibrium */
extern const record_table bone_depth_table; /* of a bone_depth */
