/* gnathos stress: does the solver survive stiff and extreme cases, and does it tell the truth about them? */
#include "app/cli/verb.h"
#include "app/stress/record.h"
#include "geometry/mem.h"
#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct stress_options {
    const char *only;
    bool list, quick;
    double patience;
} stress_options;

enum { KEY_LIST = KEY_OWN, KEY_ONLY, KEY_QUICK, KEY_PATIENCE };

static const struct argp_option options[] = {
    OPTION_OUTPUT("Folder for stress.md, stress.csv and stress.json"),
    OPTION_FORCE,
    {"list", KEY_LIST, NULL, 0, "Name the cases and run none", 0},
    {"only", KEY_ONLY, "PATTERN", 0, "Only cases whose names match, as in \"crush/*\"", 0},
    {"quick", KEY_QUICK, NULL, 0, "Leave the largest meshes out", 0},
    {"patience", KEY_PATIENCE, "FACTOR", 0, "Multiply the time limits (default 1)", 0},
    {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    stress_options *o = r->own;
    char *end;
    switch (key) {
    case KEY_LIST:
        o->list = true;
        r->need = 0;
        return 0;
    case KEY_ONLY: o->only = arg; return 0;
    case KEY_QUICK: o->quick = true; return 0;
    case KEY_PATIENCE:
        o->patience = strtod(arg, &end);
        if (end == arg || *end || !(o->patience > 0 && o->patience <= 1000))
            command_usage(state, "--patience %s: must be a number above 0, at most 1000", arg);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static int choose(const stress_options *in, const stress_case **chosen)
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

static bool run_all(const run_context *r, const stress_case *const *c, stress_result *result, int count, err *e)
{
    const stress_options *in = r->own;
    for (int i = 0; i < count; i++) {
        command_progress_at(&r->common, c[i]->name, (double)i / count);
        result[i] = stress_run(c[i], in->patience, &r->watch);
        if (command_interrupted()) return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
    }
    return true;
}

/* The first case that is wrong and not known to be is the refusal. */
static bool conclude(const run_context *r, const stress_case *const *c, const stress_result *result, int count,
                     json_t *record, err *e)
{
    bool fine = true;
    for (int i = 0; fine && i < count; i++)
        if (result[i].wrong[0] && !c[i]->known)
            fine = err_set(e, ERR_INTERNAL, "%s: %s; %s", c[i]->name, result[i].wrong, result[i].text);
    if (r->common.json)
        command_print_record(json_incref(record));
    else
        stress_print(c, result, count, stdout);
    return fine;
}

static void defaults(void *own) { *(stress_options *)own = (stress_options){.patience = 1}; }

static bool choose_some(run_context *r, err *e)
{
    const stress_options *in = r->own;
    return choose(in, NULL) > 0 ||
           err_set(e, ERR_USAGE, "--only %s: no case has such a name; --list names them", in->only);
}

static bool run(run_context *r, err *e)
{
    const stress_options *in = r->own;
    int count = choose(in, NULL);
    const stress_case **chosen = NEW_ARRAY(const stress_case *, count);
    stress_result *result = NEW_ARRAY(stress_result, count);
    bool ok = true;
    choose(in, chosen);
    if (in->list) {
        for (int i = 0; i < count; i++) printf("%-24s %s\n", chosen[i]->name, chosen[i]->what);
    } else if ((ok = run_all(r, chosen, result, count, e))) {
        json_t *record = stress_json(chosen, result, count);
        ok = (!r->out_path || (stress_write(chosen, result, count, record, r->dir.part.temporary, e) &&
                               output_dir_close(&r->dir, e))) &&
             conclude(r, chosen, result, count, record, e);
        json_decref(record);
    }
    free(chosen);
    free(result);
    return ok;
}

const verb verb_stress = {.about = "Solve stiff and extreme cases and check what the solver says of each.",
                          .options = options,
                          .need = NEED_OUTPUT,
                          .own_size = sizeof(stress_options),
                          .defaults = defaults,
                          .parse = parse,
                          .early = choose_some,
                          .run = run};
