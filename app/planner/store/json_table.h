/* json_table: rows of results as JSON objects, and the same rows as CSV. */
#pragma once
#include "geometry/json_file.h"
#include <stdio.h>

/* null where x is not finite. */
json_t *json_number(double x);

typedef struct json_column {
    const char *name;
    double value;
} json_column;
/* Sets each on the object, in order. */
void json_columns(json_t *object, const json_column *column, size_t count);

/* An array of flat objects with the same keys: a line of keys, then a line for each. null is empty, true is 1. */
void json_table_csv(const json_t *rows, FILE *out);
