/* outcome_scene: what a prediction switched on and left out, and the estimated price on the skin. */
#pragma once
#include "app/planner/predict/outcome.h"

/* {"on": [...], "left_out": [{"what", "why", "skin_error_mm"}], ...} as a new object. */
json_t *outcome_scene_json(const outcome *o);
/* Which element the tissue has, and why. */
void outcome_element_words(const outcome *o, char *out, size_t size);
/* What the tissue that was left out costs the skin at most, mm, by estimate. */
double outcome_left_out_mm(const outcome *o);
