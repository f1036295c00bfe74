#include "app/cli/verb.h"
#if GNATHOS_WITH_CGAL
#include "app/planner/patient/prepared_report.h"
#endif
#include "geometry/clock.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

static error_t take_argument(char *arg, run_context *r, struct argp_state *state)
{
    for (int i = 0; i < r->verb->argument_count; i++) {
        if (r->argument[i]) continue;
        r->argument[i] = arg;
        return 0;
    }
    command_usage(state, "one argument too many: %s", arg);
    return 0;
}

/* A second value would make the first one vanish without a word. */
static void take_once(int key, const char *arg, run_context *r, struct argp_state *state)
{
    if (!arg || key <= 0 || key >= KEY_MOST) return; /* a flag, an argument, a stage of argp */
    for (const int *k = r->verb->often; k && *k; k++)
        if (*k == key) return;
    const struct argp_option *o = r->verb->options;
    while (o->key != key) o++;
    if (r->given[key])
        command_usage(state, "--%s is given twice: %s and %s; which is meant?", o->name, r->given[key], arg);
    r->given[key] = arg;
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    run_context *r = state->input;
    const verb *v = r->verb;
    if (key == ARGP_KEY_INIT) state->child_inputs[0] = &r->common;
    if (key == ARGP_KEY_END && v->missing_plan && !r->plan_path) command_usage(state, "%s", v->missing_plan);
    if (key == ARGP_KEY_END && v->missing_output && !r->out_path) command_usage(state, "%s", v->missing_output);
    take_once(key, arg, r, state);
    error_t own = v->parse ? v->parse(key, arg, r, state) : ARGP_ERR_UNKNOWN;
    if (own != ARGP_ERR_UNKNOWN) return own;
    switch (key) {
    case 'p': r->plan_path = arg; return 0;
    case 'o': r->out_path = arg; return 0;
    case 'f': r->force = true; return 0;
    case KEY_CACHE: r->cache = arg; return 0;
    case ARGP_KEY_ARG: return take_argument(arg, r, state);
    case ARGP_KEY_NO_ARGS:
        if (v->missing_argument) command_usage(state, "%s", v->missing_argument);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static bool open_plan(run_context *r, err *e)
{
    char own[FIELD_PATH_SIZE + 16];
    const char *path = r->plan_path;
    snprintf(own, sizeof own, "%s/plan.json", r->patient.folder);
    if (!path && r->need & NEED_PLAN_OF_CASE) path = own;
    if (!path) return true;
    if (r->need & NEED_PLAN) return plan_moves_load(path, &r->patient, &r->points, &r->plan, &r->moves, e);
    issue_list issues = {0};
    bool made = plan_file_read(path, &r->patient, &r->plan, &issues) &&
                plan_moves_set(&r->plan, &r->patient, &r->points, &r->moves, &issues);
    bool ok = issue_none_is_error(&issues, e) && made;
    issue_list_free(&issues);
    return ok;
}

bool verb_prepare_case(run_context *r, err *e)
{
#if GNATHOS_WITH_CGAL
    if (!prepared_get(&r->patient, r->cache, &r->watch, &r->prepared, e)) return false;
    issue_list warnings = prepared_warnings(&r->prepared, &r->patient);
    command_print_issues(&r->common, &warnings);
    issue_list_free(&warnings);
    return true;
#else
    (void)r;
    return err_set(e, ERR_INTERNAL, "this build prepares nothing (GNATHOS_CGAL=OFF)");
#endif
}

static bool open_all(run_context *r, err *e)
{
    unsigned need = r->need;
    return (!(need & NEED_CASE) || case_file_load(r->argument[0], &r->patient, e)) &&
           (!(need & NEED_POINTS) || landmarks_read(r->patient.landmarks, &r->points, NULL, e)) &&
           (!r->verb->early || r->verb->early(r, e)) && (!(need & (NEED_PLAN | NEED_PLAN_JUDGED)) || open_plan(r, e)) &&
           (!(need & NEED_OUTPUT) || !r->out_path || output_dir_open(r->out_path, r->force, &r->dir, e)) &&
           (!(need & NEED_PREPARED) || verb_prepare_case(r, e));
}

static void close_all(run_context *r)
{
    output_dir_abandon(&r->dir);
    landmarks_free(&r->points);
#if GNATHOS_WITH_CGAL
    prepared_free(&r->prepared);
#endif
}

int verb_run(const verb *v, int argc, char **argv)
{
    const struct argp argp = {v->options, parse, v->arguments, v->about, command_common, NULL, NULL};
    run_context *r = NEW_ARRAY(run_context, 1);
    err e = {0};
    r->verb = v;
    r->need = v->need;
    r->own = mem_alloc(1, v->own_size);
    r->plan = plan_file_default();
    if (v->defaults) v->defaults(r->own);
    argp_parse(&argp, argc, argv, 0, NULL, r);
    r->watch = command_task(&r->common);
    r->start = clock_now();
    bool ok = open_all(r, &e) && v->run(r, &e);
    int status = ok ? r->status : command_fail(&e);
    close_all(r);
    free(r->own);
    free(r);
    return status;
}
