/* gnathos ceph CASE|OUT: angles and distances of the profile, before and as planned. */
#include "app/planner/patient/case_file.h"
#include "app/planner/predict/ceph_report.h"
#include "app/cli/ceph_print.h"
#include "app/cli/command.h"
#include "app/planner/predict/outcome_read.h"
#include <string.h>

struct input {
    command_options common;
    const char *folder[1];
    char sex;
};

static const struct argp_option options[] = {{"sex", 's', "f|m", 0, "Show the norm of women or of men alone", 0}, {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 's':
        if (strcmp(arg, "f") != 0 && strcmp(arg, "m") != 0) argp_error(state, "--sex is f or m, not %s", arg);
        in->sex = *arg;
        return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->folder, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name a case or the folder of an outcome"); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int command_ceph(int argc, char **argv)
{
    static const struct argp argp = {options,
                                     parse,
                                     "CASE|OUT",
                                     "Cephalometry of a case, or of an outcome of gnathos predict: before and as "
                                     "planned, with the norms of adults.",
                                     command_common,
                                     NULL,
                                     NULL};
    struct input in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    err e = {0};
    outcome_record r = {0};
    bool planned = is_outcome(in.folder[0]), ok;
    if (planned) {
        ok = outcome_record_read(in.folder[0], &r, &e);
    } else {
        case_file c;
        ok = case_file_load(in.folder[0], &c, &e) && landmarks_read(c.landmarks, &r.before, NULL, &e) &&
             head_frame_from_landmarks(&r.before, &r.frame, &e);
    }
    const landmarks *after = planned ? &r.after : NULL;
    if (ok && in.common.json)
        command_print_json(json_pack("{so}", "cephalometry", ceph_report_json(&r.before, after, &r.frame)), "ceph");
    else if (ok)
        ceph_print(&r.before, after, &r.frame, in.sex);
    outcome_record_free(&r);
    return ok ? 0 : command_fail(&e);
}
