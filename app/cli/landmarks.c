/* gnathos landmarks CASE -o FILE: the landmarks of a head, placed by the program. */
#include "app/cli/landmarks_record.h"
#include "app/cli/verb.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { KEY_BOUND = KEY_OWN };

typedef struct landmarks_options {
    double most_mm;
} landmarks_options;

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "The markups to write (.mrk.json)", 0},
    {"bound", KEY_BOUND, "MM", 0,
     "Write points that may be farther off than this (5) as not placed: they are named, and nothing uses them", 0},
    {"force", 'f', NULL, 0, "Replace FILE", 0},
    {0}};

static void defaults(void *own) { *(landmarks_options *)own = (landmarks_options){.most_mm = LANDMARK_DOUBT_MOST_MM}; }

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    landmarks_options *o = r->own;
    char *end;
    if (key != KEY_BOUND) return ARGP_ERR_UNKNOWN;
    o->most_mm = strtod(arg, &end);
    if (end == arg || *end || !(o->most_mm > 0 && o->most_mm <= 100))
        command_usage(state, "--bound=%s: must be a number above 0, up to 100", arg);
    return 0;
}

static void print_plain(const head_landmarks *l, double most_mm, const char *path)
{
    double sum = 0;
    int doubtful = 0;
    printf("%-10s %9s %9s %9s %8s %8s\n", "landmark", "left", "posterior", "up", "about", "moved");
    for (int32_t i = 0; i < l->count; i++) {
        const head_landmark *p = &l->item[i];
        printf("%-10s %9.2f %9.2f %9.2f %5.1f mm %5.1f mm%s\n", p->label, p->at[0], p->at[1], p->at[2], p->doubt_mm,
               p->moved_mm, p->doubt_mm > most_mm ? "  not placed" : "");
        sum += p->doubt_mm;
        doubtful += p->doubt_mm > most_mm;
    }
    printf("%s: %d landmarks, about %.1f mm in the mean, %d beyond %g mm; the mouth is %s\n", command_shown(path),
           l->count, sum / l->count, doubtful, most_mm, l->mouth_open ? "open" : "closed");
}

static void name_doubtful(const run_context *r, const head_landmarks *l, double most_mm)
{
    char names[800] = "";
    size_t n = 0;
    for (int32_t i = 0; i < l->count; i++)
        if (l->item[i].doubt_mm > most_mm && n < sizeof names)
            n += (size_t)snprintf(names + n, sizeof names - n, " %s", l->item[i].label);
    if (n)
        command_note(&r->common,
                     "may be more than %g mm off and are written as not placed; place them, or say a wider --bound:%s",
                     most_mm, names);
}

static bool run(run_context *r, err *e)
{
    const landmarks_options *o = r->own;
    const char *path = r->out_path;
    size_t n = strlen(path);
    if (n < 9 || strcmp(path + n - 9, ".mrk.json"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "landmarks are written as .mrk.json");
    if (!r->force && !access(path, F_OK))
        return err_at(e, ERR_USAGE, path, 0, NULL, "is there already; --force replaces it");
    head_scan scan = {0};
    head_landmarks found = {0};
    bool ok = case_file_load_bare(r->argument[0], &r->patient, e) && head_scan_read(&r->patient, false, &scan, e) &&
              head_landmarks_place(&scan, &r->watch, &found, e);
    if (ok) {
        landmarks points = head_landmarks_points(&found);
        ok = landmarks_write_sure(&points, o->most_mm, path, e);
        landmarks_free(&points);
    }
    if (ok) name_doubtful(r, &found, o->most_mm);
    if (ok && r->common.json) {
        const landmarks_record of = {path, o->most_mm, &found};
        command_print_record(record_json(&landmarks_record_table, &of));
    } else if (ok && !r->common.quiet) {
        print_plain(&found, o->most_mm, path);
    }
    head_landmarks_free(&found);
    head_scan_free(&scan);
    return ok;
}

const verb verb_landmarks = {
    .arguments = "CASE -o FILE",
    .about = "Places the landmarks of a head by itself: the template is fitted to skin, skull, mandible and teeth and "
             "carries them there; each then goes to where the surface has what its definition asks for. Landmarks that "
             "the case has are not asked. Every point tells in its description how far off it may be; look at them "
             "in 3D Slicer before they are used, and clear the description of what you correct.",
    .options = options,
    .argument_count = 1,
    .missing_argument = "name a case: a folder or its case.json",
    .missing_output = "name the file to write with -o",
    .own_size = sizeof(landmarks_options),
    .defaults = defaults,
    .parse = parse,
    .run = run};
