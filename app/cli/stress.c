/* gnathos stress: does the solver survive stiff and extreme cases, and does it tell the truth about them? */
#include "app/cli/command.h"
#include "app/planner/store/output_dir.h"
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>

struct input {
    command_options common;
    const char *out, *only;
    bool force, list, quick;
    double patience;
};

enum { KEY_LIST = 300, KEY_ONLY, KEY_QUICK, KEY_PATIENCE };

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "Folder for stress.md, stress.csv and manifest.json", 0},
    {"force", 'f', NULL, 0, "Replace an earlier output in DIR", 0},
    {"list", KEY_LIST, NULL, 0, "Name the cases and run none", 0},
    {"only", KEY_ONLY, "PATTERN", 0, "Only cases whose names match, as in \"crush/*\"", 0},
    {"quick", KEY_QUICK, NULL, 0, "Leave the largest meshes out", 0},
    {"patience", KEY_PATIENCE, "FACTOR", 0, "Multiply the time limits (default 1)", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    char *end;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 'o': in->out = arg; return 0;
    case 'f': in->force = true; return 0;
    case KEY_LIST: in->list = true; return 0;
    case KEY_ONLY: in->only = arg; return 0;
    case KEY_QUICK: in->quick = true; return 0;
    case KEY_PATIENCE:
        in->patience = strtod(arg, &end);
        if (end == arg || *end || !(in->patience > 0 && in->patience <= 1000))
            argp_error(state, "--patience %s: must be a number above 0, at most 1000", arg);
        return 0;
    case ARGP_KEY_ARG: return command_take(arg, NULL, 0, state);
    default: return ARGP_ERR_UNKNOWN;
    }
}

static int choose(const struct input *in, const stress_case **chosen)
{
    static const stress_family *const families[] = {&stress_materials, &stress_shapes, &stress_moves,
                                                    &stress_touching,  &stress_meshes, &stress_numbers};
    int count = 0;
    for (size_t f = 0; f < sizeof families / sizeof *families; f++)
        for (int i = 0; i < families[f]->count; i++) {
            const stress_case *c = &families[f]->item[i];
            if (in->quick && c->heavy) continue;
            if (in->only && fnmatch(in->only, c->name, 0)) continue;
            if (chosen) chosen[count] = c;
            count++;
        }
    return count;
}

static bool run_all(const struct input *in, const stress_case *const *c, stress_result *r, int count, err *e)
{
    const task watch = command_task(&in->common);
    for (int i = 0; i < count; i++) {
        command_progress_at(&in->common, c[i]->name, (double)i / count);
        r[i] = stress_run(c[i], in->patience, &watch);
        if (command_interrupted()) return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
    }
    return true;
}

static int conclude(const struct input *in, const stress_case *const *c, const stress_result *r, int count, err *e)
{
    int wrong = 0;
    for (int i = 0; i < count; i++)
        if (r[i].wrong[0] && !c[i]->known && wrong++ < 1)
            err_set(e, ERR_INTERNAL, "%s: %s; %s", c[i]->name, r[i].wrong, r[i].text);
    if (in->common.json)
        command_print_json(stress_json(c, r, count), "stress");
    else
        stress_print(c, r, count, stdout);
    return wrong ? command_fail(e) : 0;
}

int command_stress(int argc, char **argv)
{
    static const struct argp argp = {
        options,        parse, NULL, "Solve stiff and extreme cases and check what the solver says of each.",
        command_common, NULL,  NULL};
    struct input in = {.patience = 1};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    err e = {0};
    int count = choose(&in, NULL);
    if (count == 0) {
        err_set(&e, ERR_USAGE, "--only %s: no case has such a name; --list names them", in.only);
        return command_fail(&e);
    }
    const stress_case **chosen = NEW_ARRAY(const stress_case *, count);
    choose(&in, chosen);
    stress_result *results = NEW_ARRAY(stress_result, count);
    output_dir dir = {0};
    int status = 0;
    if (in.list) {
        for (int i = 0; i < count; i++) printf("%-24s %s\n", chosen[i]->name, chosen[i]->what);
    } else if ((!in.out || output_dir_open(in.out, in.force, &dir, &e)) && run_all(&in, chosen, results, count, &e) &&
               (!in.out ||
                (stress_write(chosen, results, count, dir.part.temporary, &e) && output_dir_close(&dir, &e)))) {
        status = conclude(&in, chosen, results, count, &e);
    } else {
        if (in.out) output_dir_abandon(&dir);
        status = command_fail(&e);
    }
    free(chosen);
    free(results);
    return status;
}
