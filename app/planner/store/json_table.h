/* json_table: rows of a record as CSV. */
#pragma once
#include "geometry/json_file.h"
#include <stdio.h>

/* An array of flat objects with the same keys: a line of keys, then a line for each. null is empty, true is 1. */
void json_table_csv(const json_t *rows, FILE *out);
