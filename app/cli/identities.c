/* gnathos identities learn | show | project | make: what heads have in common, and new ones. */
#include "app/cli/verb.h"
#include "app/identities/identities.h"
#include "app/planner/identity/template_get.h"
#include "app/planner/store/user_cache.h"
#include "geometry/mem.h"
#include "geometry/suggest.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { KEY_NORM = KEY_OWN, KEY_SEED, KEY_P, KEY_RANDOM };

static const struct argp_option options[] = {
    {"output", 'o', "PATH", 0,
     "learn: the model's file (the user's own where absent); show and project: a folder for tables and pictures; make: the case",
     0},
    {"force", 'f', NULL, 0, "Replace an earlier output", 0},
    {NULL, 0, NULL, 0, "learn:", 1},
    {"norm", KEY_NORM, "N", 0, "Also from N heads drawn from published norms, sexes and classes in turn", 1},
    {NULL, 0, NULL, 0, "make:", 2},
    {"p", KEY_P, "A,B,...", 0, "Coefficients of the first modes, in standard deviations", 2},
    {"random", KEY_RANDOM, NULL, 0, "Draw all of them", 2},
    {NULL, 0, NULL, 0, "learn --norm and make --random:", 3},
    {"seed", KEY_SEED, "N", 0, "Of what is drawn (where absent 1)", 3},
    {0}};

static const char about[] =
    "What heads have in common and how they differ, and new heads from that.\v"
    "  learn CASE...            fit the template to each head and find their main directions, 40 at most\n"
    "  show [MODEL] [-o DIR]    variance of each mode, error of heads left out; pictures of mean and modes\n"
    "  project [MODEL] CASE     coefficients of a head, and what the model makes of it; -o DIR: an error map\n"
    "  make [MODEL] -o CASE     a new head, of --p or --random, as a case that predict takes\n\n"
    "Without MODEL (learn: -o) it is the user's own: identities-2.model in $XDG_CACHE_HOME/gnathos or ~/.cache/gnathos, or "
    "what GNATHOS_IDENTITIES names. "
    "CASE may be a folder of gnathos fit: what it holds is not fitted again. learn keeps the fits in MODEL.journal while it runs: after an interruption the same command goes on from there.";

typedef enum word { LEARN, SHOW, PROJECT, MAKE, WORDS } word;
static const char *const word_name[WORDS] = {"learn", "show", "project", "make"};

typedef struct identities_options {
    int what; /* word; WORDS: not said yet */
    int count;
    const char **path; /* after the word */
    identities_learn learn;
    identities_made made;
    const char *model; /* NULL: the user's own */
    char own_model[FIELD_PATH_SIZE];
    bool has_p;
    const char *of_learn, *of_make, *seed; /* names of options that were given */
} identities_options;

static long long whole(const char *name, const char *arg, long long low, long long high, struct argp_state *state)
{
    char *end;
    errno = 0;
    long long value = strtoll(arg, &end, 10);
    if (end == arg || *end || errno || value < low || value > high)
        command_usage(state, "%s %s: must be a whole number from %lld to %lld", name, arg, low, high);
    return value;
}

static void read_p(identities_made *m, const char *arg, struct argp_state *state)
{
    for (const char *at = arg;;) {
        char *end;
        double x = strtod(at, &end);
        if (m->p_count == HEAD_MODES_MOST)
            command_usage(state, "--p %s: more than %d coefficients", arg, HEAD_MODES_MOST);
        if (end == at || !isfinite(x) || (*end && *end != ','))
            command_usage(state, "--p %s: must be numbers with commas between them", arg);
        m->p[m->p_count++] = x;
        if (!*end) return;
        at = end + 1;
    }
}

static void take_word(identities_options *o, const char *arg, struct argp_state *state)
{
    for (o->what = 0; o->what < WORDS && strcmp(arg, word_name[o->what]); o->what++) {}
    if (o->what < WORDS) return;
    int near = suggest_nearest(arg, word_name, WORDS);
    command_usage(state, "identities %s: there are learn, show, project and make%s%s%s", arg,
                  near >= 0 ? "; did you mean " : "", near >= 0 ? word_name[near] : "", near >= 0 ? "?" : "");
}

static void check(run_context *r, struct argp_state *state)
{
    identities_options *o = r->own;
    static const int most[WORDS] = {[SHOW] = 1, [PROJECT] = 2, [MAKE] = 1};
    if (o->what == WORDS) command_usage(state, "say learn, show, project or make");
    if (o->what != LEARN && o->of_learn)
        command_usage(state, "%s belongs to learn, not to %s", o->of_learn, word_name[o->what]);
    if (o->what != MAKE && o->of_make)
        command_usage(state, "%s belongs to make, not to %s", o->of_make, word_name[o->what]);
    if (o->seed && !(o->what == LEARN && o->learn.norm_heads) && !(o->what == MAKE && o->made.random))
        command_usage(state, "--seed belongs to learn --norm and make --random");
    if (o->what == PROJECT && !o->count) command_usage(state, "name a case");
    if (o->what != LEARN && o->count > most[o->what])
        command_usage(state, "one argument too many: %s", o->path[most[o->what]]);
    if (o->what == LEARN && !o->count && !o->learn.norm_heads)
        command_usage(state, "name cases to learn from, or --norm N");
    if (o->what == MAKE && !r->out_path) command_usage(state, "name a folder for the case with -o");
    if (o->what == MAKE && o->has_p == o->made.random) command_usage(state, "say either --p or --random");
    if (o->what == MAKE && r->force) command_usage(state, "make replaces no case: name a new folder");
    o->model = o->what == LEARN ? r->out_path : o->count == most[o->what] ? o->path[0] : NULL;
}

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    identities_options *o = r->own;
    switch (key) {
    case KEY_NORM: o->learn.norm_heads = (int32_t)whole(o->of_learn = "--norm", arg, 1, 100000, state); return 0;
    case KEY_SEED:
        o->learn.seed = o->made.seed = (uint64_t)whole(o->seed = "--seed", arg, 1, INT64_MAX, state);
        return 0;
    case KEY_P:
        o->of_make = "--p";
        o->has_p = true;
        read_p(&o->made, arg, state);
        return 0;
    case KEY_RANDOM:
        o->of_make = "--random";
        o->made.random = true;
        return 0;
    case ARGP_KEY_ARG:
        if (o->what == WORDS) {
            take_word(o, arg, state);
        } else {
            o->path = GROW_ARRAY(const char *, o->path, o->count + 1);
            o->path[o->count++] = arg;
        }
        return 0;
    case ARGP_KEY_END: check(r, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void defaults(void *own)
{
    *(identities_options *)own = (identities_options){.what = WORDS, .learn = {.seed = 1}, .made = {.seed = 1}};
}

static bool open_output(run_context *r, err *e) { return output_dir_open(r->out_path, r->force, &r->dir, e); }

static void tell(const run_context *r, json_t *record)
{
    if (r->common.json)
        command_print_record(record);
    else
        json_decref(record);
}

static bool learn(run_context *r, const head_template *t, err *e)
{
    identities_options *o = r->own;
    identities_learnt l = {0};
    o->learn.cases = o->path;
    o->learn.case_count = o->count;
    o->learn.anew = r->force;
    if (!identities_learn_write(t, &o->learn, o->model, &r->watch, &l, e)) return false;
    tell(r, identities_json(&l));
    if (!r->common.json) identities_print(&l, stdout);
    head_model_free(&l.model);
    return true;
}

static bool show(run_context *r, const head_template *t, head_model *m, err *e)
{
    identities_learnt l = {.model = *m};
    bool ok = !r->out_path ||
              (open_output(r, e) && identities_write(t, &l, r->dir.part.temporary, e) && output_dir_close(&r->dir, e));
    if (ok) tell(r, identities_json(&l));
    if (ok && !r->common.json) identities_print(&l, stdout);
    return ok;
}

static bool project(run_context *r, const head_template *t, head_model *m, err *e)
{
    const identities_options *o = r->own;
    identities_projection p = {0};
    bool ok = (!r->out_path || open_output(r, e)) && identities_project(t, m, o->path[o->count - 1], &r->watch, &p, e);
    if (ok && r->out_path) ok = identity_write(t, &p, r->dir.part.temporary, e) && output_dir_close(&r->dir, e);
    if (ok) tell(r, identity_json(&p));
    if (ok && !r->common.json) identity_print(&p, stdout);
    identities_projection_free(&p);
    return ok;
}

static bool make(run_context *r, const head_template *t, head_model *m, err *e)
{
    identities_options *o = r->own;
    issue_list warnings = {0};
    o->made.folder = r->out_path;
    bool ok = identities_make(t, m, &o->made, &r->watch, &warnings, e);
    command_print_issues(&r->common, &warnings);
    issue_list_free(&warnings);
    if (ok) tell(r, identity_made_json(&o->made));
    if (ok && !r->common.json) identity_made_print(&o->made, stdout);
    return ok;
}

/* What is wrong with the model's name is told before the template is looked for, and before the work of minutes. */
static bool find_model(const run_context *r, err *e)
{
    identities_options *o = r->own;
    bool named = o->model;
    if (!named && !head_model_place(o->own_model, e)) return false;
    if (!named) o->model = o->own_model;
    if (o->what == LEARN && !r->force && !access(o->model, F_OK))
        return err_at(e, ERR_INPUT, o->model, 0, NULL, "is there already; --force replaces it");
    if (o->what == LEARN) return named || user_cache_folders(o->model, "the model", "-o", e);
    if (!access(o->model, R_OK)) return true;
    return named ? err_at(e, ERR_INPUT, o->model, 0, NULL, "cannot be read: %s", strerror(errno))
                 : err_at(
                       e, ERR_INPUT, o->model, 0, NULL,
                       "cannot be read: %s; gnathos identities learn --norm 120 makes it, in some ten minutes, or name "
                       "a model before all else",
                       strerror(errno));
}

static bool run(run_context *r, err *e)
{
    identities_options *o = r->own;
    head_template t = {0};
    head_model m = {0};
    bool ok = find_model(r, e) && head_template_get(&r->watch, &t, NULL, e);
    if (ok && o->what == LEARN) {
        ok = learn(r, &t, e);
    } else if (ok) {
        static bool (*const work[WORDS])(run_context *, const head_template *, head_model *,
                                         err *) = {[SHOW] = show, [PROJECT] = project, [MAKE] = make};
        ok = head_model_read(o->model, &t, &m, e) && work[o->what](r, &t, &m, e);
    }
    head_model_free(&m);
    head_template_free(&t);
    free(o->path);
    return ok;
}

const verb verb_identities = {.arguments = "learn CASE...\nshow [MODEL]\nproject [MODEL] CASE\nmake [MODEL] -o CASE",
                              .about = about,
                              .options = options,
                              .own_size = sizeof(identities_options),
                              .defaults = defaults,
                              .parse = parse,
                              .run = run};
