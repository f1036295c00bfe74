/* outcome_print: a prediction on stdout. */
#pragma once
#include "app/planner/predict/outcome.h"

/* What was solved and how well, the table of millimetres and the sentence on how far to trust it. */
void outcome_print(const outcome *o);
