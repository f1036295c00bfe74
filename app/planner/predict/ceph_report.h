/* ceph_report: cephalometry in records: in outcome.json and alone. */
#pragma once
#include "app/planner/store/record.h"
#include "geometry/cephalometry.h"

typedef struct ceph_report {
    bool planned; /* there is an after */
    ceph_value before[CEPH_MEASURES_MAX], after[CEPH_MEASURES_MAX];
} ceph_report;

/* after: NULL, or the landmarks as planned. */
void ceph_report_make(const landmarks *before, const landmarks *after, const head_frame *frame, ceph_report *out);

/* Of all measures, for a record_row of a list. What cannot be measured is null, with the note naming the landmark. */
const void *ceph_report_next(const void *report, int *i, const char **key, void *space);
extern const record_table ceph_measure_table;
extern const record_table cephalometry_table; /* of a ceph_report; kind "cephalometry": what gnathos ceph prints */
