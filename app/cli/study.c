/* gnathos study CASE [--plan P] -o DIR: error against run time; --ratios: soft : hard ratios beside published
 * ones. */
#include "app/cli/command.h"
#include "app/study/study.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct input {
    command_options common;
    const char *case_path[1], *plan, *out, *cache;
    bool ratios;
};

enum { KEY_CACHE = 300, KEY_RATIOS };

static const struct argp_option options[] = {
    {"plan", 'p', "FILE", 0, "The plan (default: CASE/plan.json)", 0},
    {"output", 'o', "DIR", 0, "Folder for the study; the same command continues a study that was stopped", 0},
    {"ratios", KEY_RATIOS, NULL, 0, "The standard moves instead of a plan: soft : hard ratios", 0},
    {"cache", KEY_CACHE, "DIR", 0, "Keep the case's own mesh in DIR instead of CASE/prepared", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 'p': in->plan = arg; return 0;
    case 'o': in->out = arg; return 0;
    case KEY_RATIOS: in->ratios = true; return 0;
    case KEY_CACHE: in->cache = arg; return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->case_path, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name a case"); return 0;
    case ARGP_KEY_END:
        if (!in->out) argp_error(state, "name a folder for the study with -o");
        if (in->ratios && in->plan) argp_error(state, "--ratios has its own moves: leave --plan out");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static bool make_folder(const char *path, err *e)
{
    if (!mkdir(path, 0777) || errno == EEXIST) return true;
    return err_at(e, ERR_RESOURCE, path, 0, NULL, "cannot be made: %s", strerror(errno));
}

/* A new folder, an empty one, or one of an earlier study (the journal tells of what). */
static bool open_folder(const char *path, err *e)
{
    char marker[FIELD_PATH_SIZE], sub[FIELD_PATH_SIZE];
    snprintf(marker, sizeof marker, "%s/manifest.json", path);
    if (!make_folder(path, e)) return false;
    if (access(marker, F_OK)) {
        if (rmdir(path))
            return err_at(e, ERR_INPUT, path, 0, NULL,
                          "holds something else than a study; name a new or an empty folder");
        json_t *mark = json_pack("{ss ss}", "schema", "gnathos.study.1", "version", GNATHOS_VERSION);
        bool ok = make_folder(path, e) && json_file_write(mark, marker, e);
        json_decref(mark);
        if (!ok) return false;
    }
    json_file f;
    if (!json_file_read(marker, &f, e)) return false;
    const char *schema = json_string_value(json_object_get(f.root, "schema"));
    bool ours = schema && !strcmp(schema, "gnathos.study.1");
    json_file_free(&f);
    if (!ours)
        return err_at(e, ERR_INPUT, path, 0, NULL, "holds other results of gnathos; name a new or an empty folder");
    snprintf(sub, sizeof sub, "%s/runs", path);
    if (!make_folder(sub, e)) return false;
    snprintf(sub, sizeof sub, "%s/prepared", path);
    return make_folder(sub, e);
}

static bool run_ladder(const struct input *in, study_table *t, err *e)
{
    for (int i = 0; i < study_rung_count; i++) {
        bool fresh;
        command_progress_at(&in->common, study_rungs[i].name, (double)i / study_rung_count);
        if (!study_get(t->task, &study_rungs[i], &t->run[i], &fresh, e)) return false;
        t->count = i + 1;
    }
    command_progress_at(&in->common, "a tube with an exact answer", 0.98);
    if (!study_tubes(t->task, t->tube, e)) return false;
    return t->run[study_reference].result.solved ||
           err_set(e, ERR_NOT_CONVERGED, "the reference, %s, has no result (%s): there is nothing to compare with",
                   study_rungs[study_reference].name, t->run[study_reference].result.text);
}

static bool study(const struct input *in, study_task *work, const char *plan_name, err *e)
{
    study_table t = {.task = work,
                     .plan_name = plan_name,
                     .run = NEW_ARRAY(study_run, study_rung_count),
                     .cores = (int32_t)sysconf(_SC_NPROCESSORS_ONLN)};
    bool ok = study_task_key(work, e) && run_ladder(in, &t, e);
    if (ok) study_table_make(&t);
    ok = ok && study_write(&t, in->out, e);
    if (ok && in->common.json)
        command_print_json(study_json(&t), "study");
    else if (ok)
        study_print(&t, stdout);
    study_table_free(&t);
    return ok;
}

/* The case's own mesh is needed to know landmarks and frame. */
static bool ratios(const struct input *in, study_task *work, err *e)
{
    prepared p;
    if (!prepared_get(work->patient, in->cache, work->watch, &p, e)) return false;
    json_t *record = NULL;
    bool ok = study_ratios(work, &p, stdout, in->common.json ? &record : NULL, e);
    if (ok && record) command_print_json(record, "study_ratios");
    prepared_free(&p);
    return ok;
}

int command_study(int argc, char **argv)
{
    static const struct argp argp = {options,        parse, "CASE", "Error against run time of a case.",
                                     command_common, NULL,  NULL};
    struct input in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    const task watch = command_task(&in.common);
    err e = {0};
    case_file c;
    landmarks points = {0};
    plan_file plan = plan_file_default();
    plan_moves moves = {0};
    char own_plan[FIELD_PATH_SIZE + 16];
    if (!case_file_load(in.case_path[0], &c, &e)) return command_fail(&e);
    snprintf(own_plan, sizeof own_plan, "%s/plan.json", c.folder);
    const char *plan_path = in.plan ? in.plan : own_plan;
    bool ok = landmarks_read(c.landmarks, &points, NULL, &e) &&
              (in.ratios || plan_moves_load(plan_path, &c, &points, &plan, &moves, &e)) && open_folder(in.out, &e);
    landmarks_free(&points);
    if (!ok) return command_fail(&e);
    study_task work = {.patient = &c,
                       .watch = &watch,
                       .load_steps = plan.load_steps,
                       .folder = in.out,
                       .cache = in.cache,
                       .name = "plan"};
    memcpy(work.motion, moves.move, sizeof work.motion);
    ok = in.ratios ? ratios(&in, &work, &e) : study(&in, &work, *plan.name ? plan.name : "plan", &e);
    return ok ? 0 : command_fail(&e);
}
