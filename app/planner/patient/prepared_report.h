/* prepared_report: repair, cuts and tissue mesh of a case in numbers. */
#pragma once
#include "app/planner/patient/anatomy.h"
#include "geometry/tissue.h"
#include "geometry/json_file.h"

/* A new object. */
json_t *prepared_report(const anatomy *a, const tissue_report *r, double bones_s, double tissue_s);
/* The parts that one repair and that the cuts give. */
json_t *repair_report_json(const repair_report *r);
json_t *cuts_report(const cut_report *r);
