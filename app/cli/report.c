/* gnathos report OUT: one page to open in a browser. */
#include "app/cli/made_record.h"
#include "app/cli/verb.h"
#include "app/report/page.h"
#include "app/report/scene.h"
#include "app/report/stills.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct report_options {
    const char *audit;
    bool names, no_pictures;
} report_options;

enum { KEY_NAME = KEY_OWN, KEY_NO_PICTURES, KEY_AUDIT, PATH_SIZE = 4096 };

static const struct argp_option options[] = {
    {"output", 'o', "FILE.html", 0, "The page (OUT/report.html)", 0},
    {"audit", KEY_AUDIT, "FILE", 0,
     "What gnathos audit wrote about the case or about the plan (OUT/audit.json "
     "where it is there)",
     0},
    {"name", KEY_NAME, NULL, 0,
     "Show the names of case and plan and all other text that the user wrote; without it the "
     "page holds none of them",
     0},
    {"no-pictures", KEY_NO_PICTURES, NULL, 0,
     "Leave out the stills, which are for paper and for browsers without WebGL", 0},
    {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    report_options *o = r->own;
    size_t n;
    switch (key) {
    case 'o':
        n = strlen(arg);
        if (n < 6 || strcmp(arg + n - 5, ".html") != 0)
            command_usage(state, "-o %s: the page's name must end in .html", arg);
        r->out_path = arg;
        return 0;
    case KEY_AUDIT: o->audit = arg; return 0;
    case KEY_NAME: o->names = true; return 0;
    case KEY_NO_PICTURES: o->no_pictures = true; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* *out stays NULL where there is none. */
static bool read_audit(const run_context *r, const outcome_shapes *o, json_t **out, err *e)
{
    const report_options *in = r->own;
    char beside[PATH_SIZE];
    snprintf(beside, sizeof beside, "%s/audit.json", r->argument[0]);
    if (!in->audit && access(beside, F_OK)) return true;
    json_file f;
    if (!json_file_read(in->audit ? in->audit : beside, &f, e)) return false;
    bool ok = report_audit(&f, o->record.file.root, in->names, out, e);
    json_file_free(&f);
    return ok;
}

static bool make(const run_context *r, const char *path, size_t *bytes, err *e)
{
    const report_options *in = r->own;
    outcome_shapes o = {0};
    whole_folder stills = {0};
    json_t *audit = NULL;
    char beside[PATH_SIZE + 16];
    snprintf(beside, sizeof beside, "%s.pictures", path);
    bool ok = outcome_shapes_read(r->argument[0], &o, e) && report_record_check(&o.record.file, e) &&
              read_audit(r, &o, &audit, e);
    if (ok && !in->no_pictures) {
        command_progress_at(&r->common, "drawing the pictures", -1);
        ok = whole_folder_open(beside, &stills, e) && report_stills_draw(&o, in->names, stills.temporary, e);
    }
    if (ok) {
        report_params params = {
            .pictures = in->no_pictures ? NULL : stills.temporary, .audit = audit, .names = in->names};
        command_progress_at(&r->common, "writing the page", -1);
        ok = report_page_write(&o, &params, path, bytes, e);
    }
    whole_folder_abandon(&stills);
    json_decref(audit);
    outcome_shapes_free(&o);
    return ok;
}

static bool run(run_context *r, err *e)
{
    char path[PATH_SIZE];
    size_t bytes;
    snprintf(path, sizeof path, "%s%s", r->out_path ? r->out_path : r->argument[0], r->out_path ? "" : "/report.html");
    if (!make(r, path, &bytes, e)) return false;
    if (r->common.json) {
        json_t *files = json_pack("[s]", path);
        const made_record made = {.verb = "report", .files = files, .bytes = (int64_t)bytes};
        command_print_record(record_json(&made_record_table, &made));
        json_decref(files);
    } else if (!r->common.quiet)
        printf("%s: %.1f MB\n", command_shown(path), (double)bytes / 1e6);
    return true;
}

const verb verb_report = {.arguments = "OUT",
                          .about = "Write one page about an outcome of gnathos predict, to be opened in a browser from "
                                   "disk: the face before and as predicted in 3-D, measurements, and the evidence.",
                          .options = options,
                          .argument_count = 1,
                          .missing_argument = "name the folder of an outcome",
                          .own_size = sizeof(report_options),
                          .parse = parse,
                          .run = run};
