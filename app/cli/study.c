/* gnathos study CASE [--plan P] -o DIR: error against run time; --ratios: soft : hard ratios beside published
 * ones. */
#include "app/cli/verb.h"
#include "app/study/record.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { KEY_RATIOS = KEY_OWN };

typedef struct study_options {
    bool ratios;
} study_options;

static const struct argp_option options[] = {
    OPTION_PLAN("The plan (default: CASE/plan.json)", 0),
    OPTION_OUTPUT("Folder for the study; the same command continues a study that was stopped"),
    {"ratios", KEY_RATIOS, NULL, 0, "The standard moves instead of a plan: soft : hard ratios", 0},
    {"cache", KEY_CACHE, "DIR", 0, "Keep the case's own mesh in DIR instead of CASE/prepared", 0},
    {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    (void)arg;
    study_options *o = r->own;
    switch (key) {
    case KEY_RATIOS: o->ratios = true; return 0;
    case ARGP_KEY_END:
        if (o->ratios && r->plan_path) command_usage(state, "--ratios has its own moves: leave --plan out");
        if (o->ratios) r->need &= ~(unsigned)NEED_PLAN;
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
        json_t *mark = study_folder_json();
        bool ok = make_folder(path, e) && json_file_write(mark, marker, e);
        json_decref(mark);
        if (!ok) return false;
    }
    json_file f;
    if (!json_file_read(marker, &f, e)) return false;
    const char *holds = json_string_value(json_object_get(f.root, "holds"));
    bool known = record_check(&f, study_folder_table.kind, e), ours = holds && !strcmp(holds, "study");
    json_file_free(&f);
    if (!known) return false;
    if (!ours)
        return err_at(e, ERR_INPUT, path, 0, NULL, "holds other results of gnathos; name a new or an empty folder");
    snprintf(sub, sizeof sub, "%s/runs", path);
    if (!make_folder(sub, e)) return false;
    snprintf(sub, sizeof sub, "%s/prepared", path);
    return make_folder(sub, e);
}

/* A folder in which nothing was kept goes again. */
static void leave_folder(const char *path)
{
    static const char *const sub[] = {"runs", "prepared"};
    char name[FIELD_PATH_SIZE];
    bool empty = true;
    for (int i = 0; i < 2; i++) {
        snprintf(name, sizeof name, "%s/%s", path, sub[i]);
        empty = !rmdir(name) && empty;
    }
    snprintf(name, sizeof name, "%s/manifest.json", path);
    if (empty && !unlink(name)) rmdir(path);
}

static bool run_ladder(const run_context *r, study_table *t, err *e)
{
    for (int i = 0; i < study_rung_count; i++) {
        bool fresh;
        command_progress_at(&r->common, study_rungs[i].name, (double)i / study_rung_count);
        if (!study_get(t->task, &study_rungs[i], &t->run[i], &fresh, e)) return false;
        t->count = i + 1;
    }
    command_progress_at(&r->common, "a tube with an exact answer", 0.98);
    if (!study_tubes(t->task, t->tube, e)) return false;
    return t->run[study_reference].result.solved ||
           err_set(e, ERR_NOT_CONVERGED, "the reference, %s, has no result (%s): there is nothing to compare with",
                   study_rungs[study_reference].name, t->run[study_reference].result.text);
}

static bool study(const run_context *r, study_task *work, const char *plan_name, err *e)
{
    study_table t = {.task = work,
                     .plan_name = plan_name,
                     .run = NEW_ARRAY(study_run, study_rung_count),
                     .cores = (int32_t)sysconf(_SC_NPROCESSORS_ONLN)};
    bool ok = study_task_key(work, e) && run_ladder(r, &t, e);
    if (ok) study_table_make(&t);
    json_t *record = ok ? study_json(&t) : NULL;
    ok = ok && study_write(&t, record, r->out_path, e);
    if (ok && r->common.json)
        command_print_record(json_incref(record));
    else if (ok)
        study_print(&t, stdout);
    json_decref(record);
    study_table_free(&t);
    return ok;
}

static bool ratios(run_context *r, study_task *work, err *e)
{
    json_t *record = NULL;
    bool ok = study_ratios(work, &r->prepared, stdout, r->common.json ? &record : NULL, e);
    if (ok && record) command_print_record(record);
    return ok;
}

static bool run(run_context *r, err *e)
{
    const study_options *o = r->own;
    study_task work = {.patient = &r->patient,
                       .watch = &r->watch,
                       .load_steps = r->plan.load_steps,
                       .folder = r->out_path,
                       .cache = r->cache,
                       .name = "plan"};
    memcpy(work.motion, r->moves.move, sizeof work.motion);
    if (!open_folder(r->out_path, e)) return false;
    if (!verb_prepare_case(r, e)) {
        leave_folder(r->out_path);
        return false;
    }
    return o->ratios ? ratios(r, &work, e) : study(r, &work, *r->plan.name ? r->plan.name : "plan", e);
}

const verb verb_study = {.arguments = "CASE",
                         .about = "Error against run time of a case.",
                         .options = options,
                         .argument_count = 1,
                         .missing_argument = "name a case",
                         .missing_output = "name a folder for the study with -o",
                         .need = NEED_CASE | NEED_POINTS | NEED_PLAN | NEED_PLAN_OF_CASE,
                         .own_size = sizeof(study_options),
                         .parse = parse,
                         .run = run};
