/* outcome_scene: what a prediction switched on and left out, and the estimated price on the skin. */
#pragma once
#include "app/planner/predict/outcome.h"

/* {"on": [...], "left_out": [{"what", "why", "skin_error_mm"}], ...} as a new object. */
json_t *outcome_scene_json(const outcome *o);
void outcome_scene_print(const outcome *o);
