/* gnathos render OUT: pictures of an outcome. */
#include "app/cli/made_record.h"
#include "app/cli/verb.h"
#include "geometry/clock.h"
#include "app/planner/predict/outcome_read.h"
#include "app/pictures/subject.h"
#include "app/pictures/order.h"
#include "render/standard_set.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct render_options {
    int width, height;
    double range;
    render_order order;
    gallery_style style;
} render_options;

enum {
    KEY_SHOW = KEY_OWN,
    KEY_POSE,
    KEY_VIEW,
    KEY_TURNTABLE,
    KEY_OPACITY,
    KEY_RANGE,
    KEY_ZOOM,
    KEY_CENTRE,
    KEY_PERSPECTIVE,
    KEY_SEX,
    KEY_NO_LABELS
};

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "Folder for the pictures (OUT/pictures)", 0},
    {"size", 's', "WxH", 0, "Pixels of a picture (1920x1080)", 0},
    {"show", KEY_SHOW, "WHAT", 0,
     "skin (default), clear (skin over the coloured segments), bones (alone, with the lines of the cuts), "
     "displacement, "
     "signed (distance of the skins), stretch, contour (profiles over a grid), tracing (cephalometry). May "
     "be repeated",
     1},
    {"pose", KEY_POSE, "WHEN", 0,
     "both side by side (default), before, after, overlay, wipe (before on the left half), checker", 1},
    {"view", KEY_VIEW, "FROM", 0,
     "front (default), left, right, three_quarter, three_quarter_right, submental, superior, posterior, or "
     "AZIMUTH,ELEVATION[,ROLL] in degrees: 0,0 is the front, 90,0 the patient's left, 0,90 above. May be "
     "repeated",
     1},
    {"turntable", KEY_TURNTABLE, "N", 0, "N pictures all around the head, beginning at the first view", 1},
    {"zoom", KEY_ZOOM, "FACTOR", 0, "1 (default): the face fills the picture", 1},
    {"centre", KEY_CENTRE, "LABEL", 0, "The landmark in the middle of the picture", 1},
    {"perspective", KEY_PERSPECTIVE, "DEG", 0, "Full vertical angle (default: none, one scale everywhere)", 1},
    {"range", KEY_RANGE, "END", 0,
     "End of the colour range in mm, or % of stretch (from the data; signed: 10, to both sides)", 2},
    {"skin-opacity", KEY_OPACITY, "0..1", 0, "Of the skin over the bones (0.25)", 2},
    {"sex", KEY_SEX, "f|m", 0, "Norms of women or men beside the tracing (both)", 2},
    {"no-labels", KEY_NO_LABELS, NULL, 0, "Nothing but the picture", 2},
    {0}};

static bool number_of(const char *text, double low, double high, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && !*end && *out > low && *out <= high;
}

static void take(bool ok, const err *e, struct argp_state *state)
{
    if (!ok) command_usage(state, "%s", e->text);
}

static const int often[] = {KEY_SHOW, KEY_VIEW, 0};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    render_options *in = r->own;
    double number;
    char rest;
    err e = {0};
    switch (key) {
    case 's':
        if (sscanf(arg, "%dx%d%c", &in->width, &in->height, &rest) != 2 || in->width < 100 || in->height < 100 ||
            in->width > 8192 || in->height > 8192)
            command_usage(state, "--size must be WxH with 100 to 8192 pixels each, got %s", arg);
        return 0;
    case KEY_SHOW: take(order_show(arg, &in->order, &e), &e, state); return 0;
    case KEY_POSE: take(order_pose(arg, &in->order, &e), &e, state); return 0;
    case KEY_VIEW: take(order_view_add(arg, &in->order, &e), &e, state); return 0;
    case KEY_TURNTABLE:
        if (!number_of(arg, 1, ORDER_FRAMES_MAX, &number) || number != (int)number)
            command_usage(state, "--turntable must be a whole number from 2 to %d, got %s", ORDER_FRAMES_MAX, arg);
        in->order.turntable = (int)number;
        return 0;
    case KEY_ZOOM:
        if (!number_of(arg, 0.1 - 1e-12, 50, &in->style.zoom))
            command_usage(state, "--zoom must lie in 0.1 to 50, got %s", arg);
        return 0;
    case KEY_CENTRE: in->style.centre = arg; return 0;
    case KEY_PERSPECTIVE:
        if (!number_of(arg, 1 - 1e-12, 90, &in->style.perspective_deg))
            command_usage(state, "--perspective must lie in 1 to 90 degrees, got %s", arg);
        return 0;
    case KEY_RANGE:
        if (!number_of(arg, 0, 1000, &in->range))
            command_usage(state, "--range must lie above 0 and up to 1000, got %s", arg);
        return 0;
    case KEY_OPACITY:
        if (!number_of(arg, 0, 1, &in->style.skin_opacity))
            command_usage(state, "--skin-opacity must lie in (0, 1], got %s", arg);
        return 0;
    case KEY_SEX:
        if (strcmp(arg, "f") != 0 && strcmp(arg, "m") != 0) command_usage(state, "--sex is f or m, not %s", arg);
        in->style.sex = *arg;
        return 0;
    case KEY_NO_LABELS: in->style.labels = false; return 0;
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

static bool draw_order(const run_context *r, gallery *g, const char *folder, json_t *files, err *e)
{
    const render_options *in = r->own;
    int count = order_picture_count(&in->order);
    for (int i = 0; i < count; i++) {
        order_picture p = order_picture_at(&in->order, i);
        sheet what = {p.title, p.panels, p.panel_count, p.panel_count, in->width, in->height};
        char path[1400];
        if (command_interrupted()) return err_set(e, ERR_INTERRUPTED, "interrupted after %d of %d pictures", i, count);
        snprintf(path, sizeof path, "%s/%s.png", folder, p.name);
        command_progress_at(&r->common, "drawing the pictures", (double)i / count);
        if (!gallery_write(g, &what, path, e)) return false;
        json_array_append_new(files, json_string(path));
    }
    return true;
}

static bool draw_standard(const run_context *r, gallery *g, const char *folder, json_t *files, err *e)
{
    const render_options *in = r->own;
    bool *written = calloc((size_t)standard_set_count, sizeof *written);
    command_progress_at(&r->common, "drawing the pictures", -1);
    bool ok = standard_set_write(g, in->width, in->height, folder, written, e);
    for (int i = 0; ok && i < standard_set_count; i++) {
        char path[1400];
        snprintf(path, sizeof path, "%s/%s", folder, standard_set[i].file);
        if (written[i]) json_array_append_new(files, json_string(path));
    }
    free(written);
    return ok;
}

static bool draw(const run_context *r, const drawn *d, const char *folder, json_t *files, err *e)
{
    const render_options *in = r->own;
    const json_t *root = d->record.file.root;
    pictures_input what = {.case_name = text_of(root, "case"),
                           .plan_text = text_of(json_object_get(root, "plan"), "name"),
                           .hash = text_of(root, "case_hash"),
                           .skin_before = &d->skin_before,
                           .skin_after = &d->skin_after,
                           .at_rest = &d->at_rest,
                           .move = d->move,
                           .before = &d->record.before,
                           .after = &d->record.after,
                           .frame = &d->record.frame};
    pictures_subject p;
    gallery *g = NULL;
    pictures_subject_make(&what, &p);
    bool ok = true;
    for (int s = 0; ok && s < SHOW_COUNT; s++)
        if (in->order.shows[s]) ok = pictures_subject_measure(&p, (panel_show)s, e);
    ok = ok && gallery_open(&p.shown, &in->style, &g, e);
    bool made = ok && mkdir(folder, 0777) == 0;
    if (ok && !made && errno != EEXIST)
        ok = err_at(e, ERR_RESOURCE, folder, 0, NULL, "cannot be made: %s", strerror(errno));
    ok = ok &&
         (order_is_standard(&in->order) ? draw_standard(r, g, folder, files, e) : draw_order(r, g, folder, files, e));
    if (!ok && made) rmdir(folder); /* goes if no picture is in it */
    gallery_close(&g);
    pictures_subject_free(&p);
    return ok;
}

static void print(const run_context *r, json_t *files, double load_s, double draw_s, double draw_cpu_s)
{
    size_t i;
    json_t *file;
    if (r->common.json) {
        const made_record made = {.verb = "render",
                                  .files = files,
                                  .timed = true,
                                  .load_s = load_s,
                                  .draw_s = draw_s,
                                  .draw_cpu_s = draw_cpu_s};
        command_print_record(record_json(&made_record_table, &made));
        return;
    }
    if (!r->common.quiet) json_array_foreach(files, i, file) puts(json_string_value(file));
}

static void defaults(void *own)
{
    *(render_options *)own =
        (render_options){.width = PICTURES_WIDTH, .height = PICTURES_HEIGHT, .style = gallery_style_default()};
}

static bool run(run_context *r, err *e)
{
    render_options *in = r->own;
    in->style.displacement_mm = in->style.stretch_percent = in->range;
    in->style.signed_mm = in->range > 0 ? in->range : 10; /* fixed: pictures of different plans compare */
    drawn d = {0};
    char folder[1200];
    snprintf(folder, sizeof folder, "%s%s", r->out_path ? r->out_path : r->argument[0], r->out_path ? "" : "/pictures");
    json_t *files = json_array();
    bool ok = read_outcome(r->argument[0], &d, e);
    double loaded = clock_s(), cpu = clock_cpu_s();
    ok = ok && draw(r, &d, folder, files, e);
    if (ok) print(r, files, loaded - r->start.wall_s, clock_s() - loaded, clock_cpu_s() - cpu);
    json_decref(files);
    outcome_record_free(&d.record);
    surface_free(&d.skin_before);
    surface_free(&d.skin_after);
    segments_free(&d.at_rest);
    return ok;
}

const verb verb_render = {.arguments = "OUT",
                          .about =
                              "Draw pictures of an outcome of gnathos predict: the standard set, or those asked for "
                              "with --show, --pose, --view and --turntable, which are named after them.",
                          .options = options,
                          .argument_count = 1,
                          .missing_argument = "name the folder of an outcome",
                          .own_size = sizeof(render_options),
                          .defaults = defaults,
                          .parse = parse,
                          .often = often,
                          .run = run};
