/* bounds_print: how far each control may go, on stdout. */
#pragma once
#include "app/planner/bounds/write.h"

bool bounds_print(const audit *a, err *e) MUST_CHECK;
