/* ceph_report: cephalometry as a record, for outcome.json and for gnathos ceph --json. */
#pragma once
#include "geometry/cephalometry.h"
#include "geometry/json_file.h"

/* A list of all measures: name, group, what, unit, before, planned and change (after not NULL), norm of men and women
 * as [mean, sd] with its source, note. What cannot be measured is null, with the note naming the landmark. */
json_t *ceph_report_json(const landmarks *before, const landmarks *after, const head_frame *frame);
