/* fields_help: what goes into a file, as a text on stdout. */
#pragma once
#include "app/planner/store/fields.h"

void fields_help(const field_table *t);
