/* gnathos report OUT: one page to open in a browser. */
#include "app/cli/command.h"
#include "app/report/page.h"
#include "app/report/scene.h"
#include "app/report/stills.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct input {
    command_options common;
    const char *folder[1], *out, *audit;
    bool names, no_pictures;
};

enum { KEY_NAME = 300, KEY_NO_PICTURES, KEY_AUDIT, PATH_SIZE = 4096 };

static const struct argp_option options[] = {
    {"output", 'o', "FILE.html", 0, "The page (OUT/report.html)", 0},
    {"audit", KEY_AUDIT, "FILE", 0,
     "What gnathos audit wrote about the case, or with --json about the plan (OUT/audit.json "
     "where it is there)",
     0},
    {"name", KEY_NAME, NULL, 0,
     "Show the names of case and plan and all other text that the user wrote; without it the "
     "page holds none of them",
     0},
    {"no-pictures", KEY_NO_PICTURES, NULL, 0,
     "Leave out the stills, which are for paper and for browsers without WebGL", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    size_t n;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 'o':
        n = strlen(arg);
        if (n < 6 || strcmp(arg + n - 5, ".html") != 0)
            argp_error(state, "-o %s: the page's name must end in .html", arg);
        in->out = arg;
        return 0;
    case KEY_AUDIT: in->audit = arg; return 0;
    case KEY_NAME: in->names = true; return 0;
    case KEY_NO_PICTURES: in->no_pictures = true; return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->folder, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name the folder of an outcome"); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* *out stays NULL where there is none. */
static bool read_audit(const struct input *in, const outcome_shapes *o, json_t **out, err *e)
{
    char beside[PATH_SIZE];
    snprintf(beside, sizeof beside, "%s/audit.json", in->folder[0]);
    if (!in->audit && access(beside, F_OK)) return true;
    json_file f;
    if (!json_file_read(in->audit ? in->audit : beside, &f, e)) return false;
    bool ok = report_audit(&f, o->record.file.root, in->names, out, e);
    json_file_free(&f);
    return ok;
}

static bool make(const struct input *in, const char *path, size_t *bytes, err *e)
{
    outcome_shapes o = {0};
    whole_folder stills = {0};
    json_t *audit = NULL;
    char beside[PATH_SIZE + 16];
    snprintf(beside, sizeof beside, "%s.pictures", path);
    bool ok = outcome_shapes_read(in->folder[0], &o, e) && report_record_check(&o.record.file, e) &&
              read_audit(in, &o, &audit, e);
    if (ok && !in->no_pictures) {
        command_progress_at(&in->common, "drawing the pictures", -1);
        ok = whole_folder_open(beside, &stills, e) && report_stills_draw(&o, in->names, stills.temporary, e);
    }
    if (ok) {
        report_params params = {
            .pictures = in->no_pictures ? NULL : stills.temporary, .audit = audit, .names = in->names};
        command_progress_at(&in->common, "writing the page", -1);
        ok = report_page_write(&o, &params, path, bytes, e);
    }
    whole_folder_abandon(&stills);
    json_decref(audit);
    outcome_shapes_free(&o);
    return ok;
}

int command_report(int argc, char **argv)
{
    static const struct argp argp = {
        options,
        parse,
        "OUT",
        "Write one page about an outcome of gnathos predict, to be opened in a browser "
        "from disk: the face before and as predicted in 3-D, measurements, and the evidence.",
        command_common,
        NULL,
        NULL};
    struct input in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    err e = {0};
    char path[PATH_SIZE];
    size_t bytes;
    snprintf(path, sizeof path, "%s%s", in.out ? in.out : in.folder[0], in.out ? "" : "/report.html");
    if (!make(&in, path, &bytes, &e)) return command_fail(&e);
    if (!in.common.quiet) printf("%s: %.1f MB\n", path, (double)bytes / 1e6);
    return 0;
}
