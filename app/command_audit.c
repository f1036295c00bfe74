/* gnathos audit CASE --plan P */
#include "app/command_audit_plan.h"
#include <stdlib.h>

static const struct argp_option options[] = {
    {"plan", 'p', "FILE", 0, "The plan to judge (gnathos help plan)", 0},
    {"output", 'o', "DIR", 0, "Folder for the table as JSON and pictures of the worst places", 0},
    {"force", 'f', NULL, 0, "Replace an earlier output in DIR", 0},
    {"cache", 300, "DIR", 0, "Keep what is prepared in DIR instead of CASE/prepared", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    audit_plan_options *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 'p': in->plan = arg; return 0;
    case 'o': in->out = arg; return 0;
    case 'f': in->force = true; return 0;
    case 300: in->cache = arg; return 0;
    case ARGP_KEY_ARG: return command_take(arg, &in->case_path, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name a case"); return 0;
    case ARGP_KEY_END:
        if (!in->plan) argp_error(state, "name a plan with --plan");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int command_audit(int argc, char **argv)
{
    static const struct argp argp = {options, parse, "CASE", "Judge a plan by all limits of bone, teeth and nerve.",
                                     command_common, NULL, NULL};
    audit_plan_options in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    return command_audit_plan(&in);
}
