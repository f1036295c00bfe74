/* records: all kinds of records that the verbs print and write, and help on their fields. */
#pragma once
#include "app/planner/store/record.h"

/* NULL: no record has this kind. */
const record_table *records_find(const char *kind);
/* The nth (from 0); NULL: there are no more. */
const record_table *records_nth(int n);
/* Every field with its kind, unit and meaning. */
void records_help(const record_table *t);
/* The kinds, one a line. */
void records_list(void);
