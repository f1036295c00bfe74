#include "app/pictures/order.h"
#include "geometry/suggest.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const view_word[] = {"front",     "left",     "right",    "three_quarter", "three_quarter_right",
                                        "submental", "superior", "posterior"};
static const camera_view view_of[] = {
    VIEW_FRONT,     VIEW_LEFT,     VIEW_RIGHT,    VIEW_THREE_QUARTER_LEFT, VIEW_THREE_QUARTER_RIGHT,
    VIEW_SUBMENTAL, VIEW_SUPERIOR, VIEW_POSTERIOR};
static const char *const view_title[] = {
    "front",      "left profile", "right profile", "three-quarter, left", "three-quarter, right",
    "from below", "from above",   "from behind"};
enum { VIEW_WORDS = sizeof view_word / sizeof view_word[0] };

static bool refuse(const char *option, const char *text, const char *const *names, int count, err *e)
{
    char list[256] = "";
    for (int i = 0; i < count; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", names[i]);
    }
    int near = suggest_nearest(text, names, count);
    if (near >= 0)
        return err_set(e, ERR_USAGE, "%s: unknown \"%s\"; did you mean \"%s\"? There are: %s", option, text,
                       names[near], list);
    return err_set(e, ERR_USAGE, "%s: unknown \"%s\"; there are: %s", option, text, list);
}

bool order_show(const char *text, render_order *o, err *e)
{
    int show = panel_show_from_name(text);
    const char *names[SHOW_COUNT];
    for (int i = 0; i < SHOW_COUNT; i++) names[i] = panel_show_name((panel_show)i);
    if (show < 0) return refuse("--show", text, names, SHOW_COUNT, e);
    o->show_count += !o->shows[show];
    o->shows[show] = true;
    return true;
}

bool order_pose(const char *text, render_order *o, err *e)
{
    const char *names[POSE_COUNT + 1] = {[ORDER_BOTH] = "both"};
    for (int i = 0; i < POSE_COUNT; i++) names[i] = panel_pose_name((panel_pose)i);
    for (int i = 0; i <= POSE_COUNT; i++) {
        if (strcmp(names[i], text)) continue;
        o->pose = i;
        o->pose_set = true;
        return true;
    }
    return refuse("--pose", text, names, POSE_COUNT + 1, e);
}

bool order_view_add(const char *text, render_order *o, err *e)
{
    order_view v = {0};
    char rest;
    if (o->view_count == ORDER_VIEWS_MAX) return err_set(e, ERR_USAGE, "--view: at most %d views", ORDER_VIEWS_MAX);
    for (int i = 0; i < VIEW_WORDS; i++) {
        if (strcmp(text, view_word[i])) continue;
        snprintf(v.name, sizeof v.name, "%s", text);
        camera_view_angles(view_of[i], &v.azimuth_deg, &v.elevation_deg);
        o->view[o->view_count++] = v;
        return true;
    }
    int read = sscanf(text, "%lf,%lf,%lf%c", &v.azimuth_deg, &v.elevation_deg, &v.roll_deg, &rest);
    bool whole = read == 3 || (read == 2 && sscanf(text, "%*f,%*f%c", &rest) < 1);
    if (!whole || !isfinite(v.azimuth_deg) || !isfinite(v.roll_deg))
        return refuse("--view", text, view_word, VIEW_WORDS, e);
    if (!(fabs(v.elevation_deg) <= 90) || fabs(v.azimuth_deg) > 360 || fabs(v.roll_deg) > 360)
        return err_set(e, ERR_USAGE,
                       "--view %s: elevation must lie in -90 to 90 degrees, azimuth and roll in -360 to 360", text);
    int used = snprintf(v.name, sizeof v.name, "az%g_el%g", v.azimuth_deg, v.elevation_deg);
    if (v.roll_deg != 0) snprintf(v.name + used, sizeof v.name - (size_t)used, "_roll%g", v.roll_deg);
    o->view[o->view_count++] = v;
    return true;
}

bool order_is_standard(const render_order *o)
{
    return !o->show_count && !o->pose_set && !o->view_count && !o->turntable;
}

/* Profiles are drawn from the left whatever view is asked for, once. */
static bool one_view(panel_show show) { return show == SHOW_CONTOUR || show == SHOW_TRACING; }

static int views_of(const render_order *o, panel_show show)
{
    if (one_view(show)) return 1;
    return o->turntable ? o->turntable : o->view_count ? o->view_count : 1;
}

static bool shown(const render_order *o, int show) { return o->shows[show] || (!o->show_count && show == SHOW_SKIN); }

int order_picture_count(const render_order *o)
{
    int count = 0;
    for (int s = 0; s < SHOW_COUNT; s++)
        if (shown(o, s)) count += views_of(o, (panel_show)s);
    return count;
}

static order_view view_at(const render_order *o, int index)
{
    order_view v = {.name = "front"};
    if (!o->turntable) return o->view_count ? o->view[index] : v;
    if (o->view_count) v = o->view[0]; /* the turn begins there */
    snprintf(v.name, sizeof v.name, "turn_%03d", index);
    v.azimuth_deg += 360.0 * index / o->turntable;
    return v;
}

static const char *title_of_view(const order_view *v)
{
    for (int i = 0; i < VIEW_WORDS; i++)
        if (!strcmp(v->name, view_word[i])) return view_title[i];
    return NULL;
}

static order_picture make(const render_order *o, panel_show show, int index)
{
    static const char *const what[SHOW_COUNT] = {"Skin",
                                                 "Skin over the segments",
                                                 "Segments",
                                                 "Displacement of the skin",
                                                 "Signed distance of the skins",
                                                 "Stretch of the skin",
                                                 "Profile in the midsagittal plane",
                                                 "Cephalometric tracing"};
    order_picture out = {.panel_count = 1};
    order_view v = view_at(o, index);
    bool posed = panel_has_pose(show), both = posed && (!o->pose_set || o->pose == ORDER_BOTH);
    const char *view = title_of_view(&v), *pose = !posed ? "" : both ? "_both" : panel_pose_name((panel_pose)o->pose);
    if (one_view(show)) {
        snprintf(out.name, sizeof out.name, "%s", panel_show_name(show));
        snprintf(out.title, sizeof out.title, "%s", what[show]);
    } else {
        snprintf(out.name, sizeof out.name, "%s%s%s_%s", panel_show_name(show), posed && !both ? "_" : "", pose,
                 v.name);
        snprintf(out.title, sizeof out.title, "%s%s%s", what[show], view ? ", " : "", view ? view : "");
    }
    panel p = {show, both || !posed ? POSE_AFTER : (panel_pose)o->pose, v.azimuth_deg, v.elevation_deg, v.roll_deg,
               NULL};
    if (posed && p.pose == POSE_BEFORE) p.caption = "Before";
    if (posed && p.pose == POSE_AFTER) p.caption = show == SHOW_SKIN ? "Predicted" : "Planned";
    out.panels[0] = p;
    if (both) {
        out.panels[0].pose = POSE_BEFORE;
        out.panels[0].caption = "Before";
        out.panels[out.panel_count++] = p;
    }
    return out;
}

order_picture order_picture_at(const render_order *o, int index)
{
    for (int s = 0; s < SHOW_COUNT; s++) {
        if (!shown(o, s)) continue;
        int here = views_of(o, (panel_show)s);
        if (index < here) return make(o, (panel_show)s, index);
        index -= here;
    }
    assert(!"no such picture");
    return (order_picture){0};
}
