#include "app/planner/predict/ceph_report.h"
#include <math.h>
#include <stddef.h>

void ceph_report_make(const landmarks *before, const landmarks *after, const head_frame *frame, ceph_report *out)
{
    out->planned = after != NULL;
    ceph_evaluate(before, frame, out->before);
    if (after) ceph_evaluate(after, frame, out->after);
}

typedef struct measured {
    const char *name, *group, *what, *unit, *source, *note;
    bool has_planned;
    double before, planned, change;
    const ceph_norm *men, *women; /* NULL: not known */
} measured;

const void *ceph_report_next(const void *report, int *i, const char **key, void *space)
{
    const ceph_report *r = report;
    (void)key;
    if (*i >= ceph_measure_count) return NULL;
    const ceph_measure *m = &ceph_measures[*i];
    const ceph_value *was = &r->before[*i], *is = &r->after[*i];
    measured *out = space;
    *out = (measured){.name = m->name,
                      .group = m->group,
                      .what = m->what,
                      .unit = m->unit,
                      .source = m->source,
                      .note = *was->note ? was->note : NULL,
                      .has_planned = r->planned,
                      .before = was->value,
                      .planned = r->planned ? is->value : 0,
                      .change = r->planned ? is->value - was->value : 0,
                      .men = isfinite(m->men.mean) ? &m->men : NULL,
                      .women = isfinite(m->women.mean) ? &m->women : NULL};
    return out;
}

static bool has_planned(const void *of) { return ((const measured *)of)->has_planned; }

_Static_assert(sizeof(ceph_norm) == 2 * sizeof(double), "a norm is two numbers");
#define NORM_ROW(member, name_, help_)                                                                                 \
    {                                                                                                                  \
        .kind = RECORD_NUMBERS, .length = 2, .offset = offsetof(measured, member), .pointer = true, .name = name_,     \
        .or_null = true, .help = help_                                                                                 \
    }

static const record_row measured_row[] = {
    ROW(measured, name, "name", NULL, "name of the measure"),
    ROW(measured, group, "group", NULL, "the analysis it belongs to"),
    ROW(measured, what, "what", NULL, "how it is measured"),
    ROW(measured, unit, "unit", NULL, "deg, mm or %"),
    ROW(measured, before, "before", NULL, "its value before"),
    ROW_WHEN(has_planned, measured, planned, "planned", NULL, "as planned"),
    ROW_WHEN(has_planned, measured, change, "change", NULL, "the difference"),
    NORM_ROW(men, "norm_men", "mean and standard deviation of men"),
    NORM_ROW(women, "norm_women", "mean and standard deviation of women"),
    {RECORD_AT(measured, source), .name = "source", .or_null = true, .help = "of the norm"},
    ROW_OPTIONAL(measured, note, "note", NULL, "what it lacks, or what stands in for it"),
};
const record_table ceph_measure_table = {.title = "A measure of the profile", RECORD_ROWS(measured_row)};

static const record_row cephalometry_row[] = {
    ROW_LIST(ceph_report_next, &ceph_measure_table, "cephalometry", "angles and distances of the profile"),
};
const record_table cephalometry_table = {
    .kind = "cephalometry", .title = "Record of gnathos ceph", RECORD_ROWS(cephalometry_row)};
