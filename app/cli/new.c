/* gnathos new CASE: a case of a synthetic head, from published norms. */
#include "app/cli/new_record.h"
#include "app/cli/verb.h"
#include "geometry/suggest.h"
#include "cases/norm_head/norm_case.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    KEY_NORM = KEY_OWN,
    KEY_SEX,
    KEY_SEED,
    KEY_CLASS,
    KEY_OPEN_BITE,
    KEY_ASYMMETRY,
    KEY_SET,
    KEY_COARSE,
    KEY_MEASURES
};

typedef struct new_options {
    norm_head_params p;
    bool norm, list;
    bool asked; /* an option of --norm was given */
} new_options;

static const struct argp_option options[] = {
    {"norm", KEY_NORM, NULL, 0, "Make a head from published norms; where absent, CASE holds a recipe.json", 1},
    {"sex", KEY_SEX, "f|m", 0, "Norms of women (where absent) or men", 1},
    {"seed", KEY_SEED, "N", 0, "Draw the measures from their spreads; 0 (where absent) takes the means", 1},
    {"class", KEY_CLASS, "1|2|3", 0, "Skeletal class, from the size and place of the jaws", 1},
    {"open-bite", KEY_OPEN_BITE, "MM", 0, "Gap between the incisors, 0 to 8", 1},
    {"asymmetry", KEY_ASYMMETRY, "MM", 0, "Chin to the left, -12 to 12", 1},
    {"set", KEY_SET, "MEASURE=VALUE", 0, "Ask for a measure; may be repeated", 1},
    {"coarseness", KEY_COARSE, "FACTOR", 0, "Edge lengths of the meshes, 1 (where absent) to 3", 1},
    {"measures", KEY_MEASURES, NULL, 0, "List the measures with their means and stop", 2},
    {0}};

static double number(const char *arg, const char *what, struct argp_state *state)
{
    char *end;
    double value = strtod(arg, &end);
    if (end == arg || *end || !(value - value == 0)) command_usage(state, "%s %s: must be a number", what, arg);
    return value;
}

static int64_t whole(const char *arg, const char *what, int64_t low, int64_t high, struct argp_state *state)
{
    char *end;
    long long value = strtoll(arg, &end, 10);
    if (end == arg || *end || value < low || value > high)
        command_usage(state, "%s %s: must be a whole number from %lld to %lld", what, arg, (long long)low,
                      (long long)high);
    return value;
}

static void set_measure(new_options *in, const char *arg, struct argp_state *state)
{
    const char *equals = strchr(arg, '=');
    if (!equals) command_usage(state, "--set %s: write MEASURE=VALUE", arg);
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)(equals - arg), arg);
    int id = measure_find(name);
    if (id < 0) {
        const char *names[MEASURE_COUNT];
        for (int i = 0; i < MEASURE_COUNT; i++) names[i] = measures[i].name;
        int near = suggest_nearest(name, names, MEASURE_COUNT);
        if (near >= 0)
            command_usage(state, "--set %s: no such measure; did you mean %s?", name, names[near]);
        else
            command_usage(state, "--set %s: no such measure; --measures lists them", name);
    }
    if (in->p.is_set[id]) command_usage(state, "--set %s is given twice; which is meant?", name);
    in->p.set[id] = number(equals + 1, name, state);
    in->p.is_set[id] = true;
}

static const int often[] = {KEY_SET, 0};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    new_options *in = r->own;
    if (key >= KEY_SEX && key <= KEY_COARSE) in->asked = true;
    switch (key) {
    case KEY_NORM: in->norm = true; return 0;
    case KEY_SEX:
        if (strcmp(arg, "f") && strcmp(arg, "m")) command_usage(state, "--sex %s: must be f or m", arg);
        in->p.sex = arg[0] == 'm' ? NORM_MALE : NORM_FEMALE;
        return 0;
    case KEY_SEED: in->p.seed = (uint64_t)whole(arg, "--seed", 0, INT64_MAX, state); return 0;
    case KEY_CLASS: in->p.skeletal_class = (int)whole(arg, "--class", 1, 3, state); return 0;
    case KEY_OPEN_BITE: in->p.open_bite_mm = number(arg, "--open-bite", state); return 0;
    case KEY_ASYMMETRY: in->p.asymmetry_mm = number(arg, "--asymmetry", state); return 0;
    case KEY_COARSE: in->p.coarseness = number(arg, "--coarseness", state); return 0;
    case KEY_SET: set_measure(in, arg, state); return 0;
    case KEY_MEASURES: in->list = true; return 0;
    case ARGP_KEY_END:
        if (!r->argument[0] && !in->list) command_usage(state, "name the case folder to make");
        if (in->asked && !in->norm)
            command_usage(state, "this option belongs to --norm; without it the recipe decides");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void list_measures(void)
{
    printf("%-20s %14s %14s  %-20s %s\n", "measure", "women", "men", "source", "meaning");
    for (int i = 0; i < MEASURE_COUNT; i++) {
        const measure *m = &measures[i];
        printf("%-20s %6.1f +- %4.1f %6.1f +- %4.1f  %-20s %s\n", m->name, m->mean[0], m->sd[0], m->mean[1], m->sd[1],
               m->source, m->help);
    }
}

static void print_result(const run_context *r, const norm_head *h)
{
    if (r->common.json) {
        command_print_record(new_record_json(r->argument[0], h));
        return;
    }
    printf("%-20s %9s %9s\n", "measure", "asked", "obtained");
    for (int i = 0; i < MEASURE_COUNT; i++)
        printf("%-20s %9.2f %9.2f\n", measures[i].name, h->asked[i], h->obtained[i]);
}

/* The folder's own name, as the name of the case. */
static char *base_name(const char *folder)
{
    char *clean = mem_text(folder);
    for (size_t n = strlen(clean); n > 1 && clean[n - 1] == '/'; n--) clean[n - 1] = 0;
    char *slash = strrchr(clean, '/'), *name = mem_text(slash && slash[1] ? slash + 1 : clean);
    free(clean);
    return name;
}

static bool make(run_context *r, norm_head *h, err *e)
{
    new_options *in = r->own;
    const char *target = r->argument[0];
    size_t size = strlen(target) + 16;
    char *path = NEW_ARRAY(char, size), *name = base_name(target);
    snprintf(path, size, "%s/recipe.json", target);
    bool again = !in->norm, ok = true;
    if (again) ok = norm_case_read_recipe(path, &in->p, e);
    free(path);
    whole_folder folder = {0};
    if (ok && !again) ok = whole_folder_open(target, &folder, e);
    if (ok) {
        command_progress_at(&r->common, "shapes and meshes", -1);
        ok = norm_head_build(&in->p, h, e);
        if (ok && command_interrupted()) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    }
    if (ok) ok = norm_case_write(h, again ? NULL : &in->p, again ? target : folder.temporary, name, e);
    if (folder.path) {
        if (ok)
            ok = whole_folder_close(&folder, e);
        else
            whole_folder_abandon(&folder);
    }
    free(name);
    return ok;
}

static void defaults(void *own) { *(new_options *)own = (new_options){.p = norm_head_params_default()}; }

static bool run(run_context *r, err *e)
{
    const new_options *in = r->own;
    if (in->list) {
        list_measures();
        return true;
    }
    norm_head h = {0};
    bool ok = norm_head_params_check(&in->p, e) && make(r, &h, e);
    if (ok) print_result(r, &h);
    norm_head_free(&h);
    return ok;
}

const verb verb_new = {.arguments = "CASE",
                       .about =
                           "Makes a case of a head that nobody has: skin, skull, mandible, teeth and landmarks built "
                           "from published norms. CASE is a new folder with --norm, or an existing one with a "
                           "recipe.json, whose meshes are then made again.",
                       .options = options,
                       .argument_count = 1,
                       .own_size = sizeof(new_options),
                       .defaults = defaults,
                       .parse = parse,
                       .often = often,
                       .run = run};
