/* compare_print: a comparison of faces on stdout. */
#pragma once
#include "app/planner/predict/face_compare.h"

void compare_print(const face_compare *c);
