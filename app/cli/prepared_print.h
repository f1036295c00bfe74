/* prepared_print: repair, cuts and tissue mesh of a case on stdout. */
#pragma once
#include "geometry/json_file.h"

/* The record of prepared_report. */
void prepared_print(const json_t *report);
