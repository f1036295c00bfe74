/* gnathos prepare CASE: everything that does not depend on a plan, made and kept. */
#include "app/cli/command.h"
#include "app/planner/patient/prepared.h"
#include "app/cli/prepared_print.h"
#include <stdio.h>

struct input {
    command_options common;
    const char *case_path[1], *cache;
};

enum { KEY_CACHE = 300 };

static const struct argp_option options[] = {
    {"cache", KEY_CACHE, "DIR", 0, "Keep what is prepared in DIR instead of CASE/prepared", 0}, {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case KEY_CACHE: in->cache = arg; return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->case_path, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name a case"); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int command_prepare(int argc, char **argv)
{
    static const struct argp argp = {
        options,
        parse,
        "CASE",
        "Repair and cut the bones of a case and mesh its soft tissue, once; plans reuse it.",
        command_common,
        NULL,
        NULL};
    struct input in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    const task watch = command_task(&in.common);
    err e = {0};
    case_file c;
    prepared p = {0};
    if (!case_file_load(in.case_path[0], &c, &e) || !prepared_get(&c, in.cache, &watch, &p, &e))
        return command_fail(&e);
    if (in.common.json)
        command_print_json(
            json_pack("{ss sb so}", "hash", p.hash, "reused", p.reused, "prepared", json_incref(p.report)), "prepare");
    else {
        printf("%s: %s, %.16s\n", c.name, p.reused ? "was prepared already" : "prepared", p.hash);
        prepared_print(p.report);
    }
    prepared_free(&p);
    return 0;
}
