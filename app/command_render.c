/* gnathos render OUT: the pictures of an outcome, drawn again. */
#include "app/command.h"
#include "app/outcome_read.h"
#include "app/pictures.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct input {
    command_options common;
    const char *folder[1], *out;
    int width, height;
    double opacity, heat;
};

enum { KEY_OPACITY = 300, KEY_HEAT };

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "Folder for the pictures (OUT/pictures)", 0},
    {"size", 's', "WxH", 0, "Pixels of one half of a comparison (900x1000)", 0},
    {"skin-opacity", KEY_OPACITY, "0..1", 0, "Of the skin over the bones (0.25)", 0},
    {"heat-high", KEY_HEAT, "MM", 0, "End of the displacement scale (from the data)", 0},
    {0}};

static bool number_of(const char *text, double low, double high, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && !*end && *out > low && *out <= high;
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    char rest;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 'o': in->out = arg; return 0;
    case 's':
        if (sscanf(arg, "%dx%d%c", &in->width, &in->height, &rest) != 2 || in->width < 100 || in->height < 100 ||
            in->width > 4096 || in->height > 4096)
            argp_error(state, "--size must be WxH with 100 to 4096 pixels each, got %s", arg);
        return 0;
    case KEY_OPACITY:
        if (!number_of(arg, 0, 1, &in->opacity)) argp_error(state, "--skin-opacity must lie in (0, 1], got %s", arg);
        return 0;
    case KEY_HEAT:
        if (!number_of(arg, 0, 1000, &in->heat)) argp_error(state, "--heat-high must be above 0 mm, got %s", arg);
        return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->folder, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name the folder of an outcome"); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

typedef struct drawn { /* what the pictures need of an outcome */
    outcome_record record;
    surface skin_before, skin_after;
    segments at_rest;
    rigid move[SEGMENT_COUNT];
} drawn;

static const char *text_of(const json_t *o, const char *key)
{
    const char *t = json_string_value(json_object_get(o, key));
    return t ? t : "";
}

static bool read_outcome(const char *folder, drawn *d, err *e)
{
    return outcome_record_read(folder, &d->record, e) && outcome_skin_read(folder, false, &d->skin_before, e) &&
           outcome_skin_read(folder, true, &d->skin_after, e) &&
           outcome_segments_read(folder, &d->record, &d->at_rest, d->move, e);
}

int command_render(int argc, char **argv)
{
    static const struct argp argp = {options, parse, "OUT",
                                     "Draw the before and after pictures of an outcome of gnathos predict.",
                                     command_common, NULL, NULL};
    struct input in = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    err e = {0};
    drawn d = {0};
    char folder[1200];
    snprintf(folder, sizeof folder, "%s%s", in.out ? in.out : in.folder[0], in.out ? "" : "/pictures");
    bool ok = read_outcome(in.folder[0], &d, &e);
    if (ok && mkdir(folder, 0777) && errno != EEXIST)
        ok = err_at(&e, ERR_RESOURCE, folder, 0, NULL, "cannot be made: %s", strerror(errno));
    if (ok) {
        const json_t *root = d.record.file.root;
        pictures_input pictures = {.case_name = text_of(root, "case"),
                                   .plan_text = text_of(json_object_get(root, "plan"), "name"),
                                   .hash = text_of(root, "case_hash"),
                                   .skin_before = &d.skin_before,
                                   .skin_after = &d.skin_after,
                                   .at_rest = &d.at_rest,
                                   .move = d.move,
                                   .points = &d.record.before,
                                   .frame = &d.record.frame,
                                   .width = in.width,
                                   .height = in.height,
                                   .skin_opacity = in.opacity,
                                   .heat_high_mm = in.heat};
        command_progress_at(&in.common, "drawing the pictures", -1);
        ok = pictures_write(&pictures, folder, !in.common.quiet, &e);
    }
    outcome_record_free(&d.record);
    surface_free(&d.skin_before);
    surface_free(&d.skin_after);
    segments_free(&d.at_rest);
    return ok ? 0 : command_fail(&e);
}
