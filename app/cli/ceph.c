/* gnathos ceph CASE|OUT: angles and distances of the profile, before and as planned. */
#include "app/cli/ceph_print.h"
#include "app/cli/verb.h"
#include "app/planner/predict/ceph_report.h"
#include "app/planner/predict/outcome_read.h"
#include <string.h>

typedef struct ceph_options {
    char sex;
} ceph_options;

static const struct argp_option options[] = {{"sex", 's', "f|m", 0, "Show the norm of women or of men alone", 0}, {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    ceph_options *o = r->own;
    if (key != 's') return ARGP_ERR_UNKNOWN;
    if (strcmp(arg, "f") != 0 && strcmp(arg, "m") != 0) command_usage(state, "--sex is f or m, not %s", arg);
    o->sex = *arg;
    return 0;
}

static bool run(run_context *r, err *e)
{
    const ceph_options *o = r->own;
    outcome_record record = {0};
    bool planned = is_outcome(r->argument[0]), ok;
    if (planned)
        ok = outcome_record_read(r->argument[0], &record, e);
    else
        ok = case_file_load(r->argument[0], &r->patient, e) &&
             landmarks_read(r->patient.landmarks, &record.before, NULL, e) &&
             head_frame_from_landmarks(&record.before, &record.frame, e);
    const landmarks *after = planned ? &record.after : NULL;
    if (ok && r->common.json) {
        ceph_report report;
        ceph_report_make(&record.before, after, &record.frame, &report);
        command_print_record(record_json(&cephalometry_table, &report));
    } else if (ok)
        ceph_print(&record.before, after, &record.frame, o->sex);
    outcome_record_free(&record);
    return ok;
}

const verb verb_ceph = {.arguments = "CASE|OUT",
                        .about =
                            "Cephalometry of a case, or of an outcome of gnathos predict: before and as planned, with "
                            "the norms of adults.",
                        .options = options,
                        .argument_count = 1,
                        .missing_argument = "name a case or the folder of an outcome",
                        .own_size = sizeof(ceph_options),
                        .parse = parse,
                        .run = run};
