/* The lines and planes of cephalometry, before and planned, over a faded lateral view, beside the table of
 * measures. */
#include "render/src/profile.h"
#include "geometry/cephalometry.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ink[3] = {0.16, 0.19, 0.23}, faint[3] = {0.45, 0.49, 0.54}, rule[3] = {0.85, 0.87, 0.89};
static const double margin_mm = 12, fade = 0.45; /* of the view behind the lines */
static const double same_mm = 0.1;               /* what moves less is drawn once */
static const char *const framed[] = {"S", "Po", "Pn", "G'", "N'", "Me'", "Gn'", "Go", "Me", "C", NULL};

/* From a to b, prolonged beyond them by these shares of their distance. */
static const struct {
    const char *from, *to, *name;
    double before_share, after_share;
} planes[] = {
    {"S", "N", "SN", 0.05, 0.08},
    {"Po", "Or", "FH", 0.05, 0.25},
    {"PNS", "ANS", "PP", 0.10, 0.15},
    {"occlusal_6", "occlusal_3", "OP", 0.5, 0.5},
    {"Go", "Me", "MP", 0.08, 0.12},
    {"N", "A", NULL, 0, 0.15},
    {"N", "B", NULL, 0, 0},
    {"N", "Pog", NULL, 0, 0.08},
    {"Co", "Gn", NULL, 0, 0},
    {"U1_apex", "U1", NULL, 0.35, 0.15},
    {"L1_apex", "L1", NULL, 0.35, 0.15},
    {"Pn", "Pg'", "E", 0.10, 0.10},
};
static const char *const dots[] = {"S",  "N",  "Po", "Or", "ANS",     "PNS", "A",       "B",  "Pog",
                                   "Gn", "Me", "Go", "Co", "Ar",      "U1",  "U1_apex", "L1", "L1_apex",
                                   "G'", "Pn", "Sn", "Ls", "Li_soft", "B'",  "Pg'",     "Me'"};

static bool same_point(const double a[3], const double b[3]) { return vec_distance(a, b) < same_mm; }

/* Lines run in the midsagittal projection; the camera looks along it. */
static void draw_planes(const profile *f, bool after)
{
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        double a[2][3], b[2][3], along[3], from[3], to[3], x, y, near_mm;
        bool there = true;
        for (int k = 0; k < 2; k++)
            there &= profile_point(f, k, planes[i].from, a[k]) && profile_point(f, k, planes[i].to, b[k]);
        if (!there) continue;
        bool same = same_point(a[0], a[1]) && same_point(b[0], b[1]);
        if (same && after) continue;
        vec_sub(b[after], a[after], along);
        vec_axpy(a[after], -planes[i].before_share, along, from);
        vec_axpy(b[after], planes[i].after_share, along, to);
        profile_line(f, from, to, 0.10 * f->size, same ? profile_same_rgb : profile_rgb[after]);
        if (after || !planes[i].name || !f->g->style->labels) continue;
        camera_project(&f->view, f->width, f->height, from, &x, &y, &near_mm);
        pen_text(f->p, x + 0.3 * f->size, y + 0.25 * f->size, LABEL_LEFT, 0.75 * f->size, true, faint, planes[i].name);
    }
    /* true vertical line through subnasale */
    double sn[3], other[3], top[3], bottom[3], me[3];
    if (profile_point(f, after, "Sn", sn) && profile_point(f, !after, "Sn", other) &&
        (profile_point(f, after, "Me'", me) || profile_point(f, after, "Pg'", me))) {
        vec_sub(sn, other, top);
        bool same = fabs(vec_dot(top, f->g->s->frame.posterior)) < same_mm;
        vec_axpy(sn, 30, f->g->s->frame.up, top);
        vec_sub(me, sn, bottom);
        vec_axpy(sn, vec_dot(bottom, f->g->s->frame.up) - 6, f->g->s->frame.up, bottom);
        if (!same || !after) profile_line(f, top, bottom, 0.10 * f->size, same ? profile_same_rgb : profile_rgb[after]);
        double x, y, near_mm;
        camera_project(&f->view, f->width, f->height, top, &x, &y, &near_mm);
        if (!after && f->g->style->labels)
            pen_text(f->p, x, y - 0.3 * f->size, LABEL_CENTRE, 0.75 * f->size, true, faint, "TVL");
    }
}

static void draw_dots(const profile *f)
{
    double at[2][3], x, y, near_mm;
    for (size_t i = 0; i < sizeof dots / sizeof *dots; i++) {
        if (!profile_point(f, false, dots[i], at[0]) || !profile_point(f, true, dots[i], at[1])) continue;
        bool same = same_point(at[0], at[1]);
        profile_dot(f, at[0], 0.17 * f->size, same ? profile_same_rgb : profile_rgb[0]);
        if (!same) profile_dot(f, at[1], 0.17 * f->size, profile_rgb[1]);
        camera_project(&f->view, f->width, f->height, at[0], &x, &y, &near_mm);
        if (f->g->style->labels && !strchr(dots[i], '_'))
            pen_text(f->p, x + 0.4 * f->size, y - 0.3 * f->size, LABEL_LEFT, 0.68 * f->size, false, ink, dots[i]);
    }
}

/* The view before, as a pale picture behind the lines. */
static bool draw_ground(const profile *f, image *out, err *e)
{
    gallery *g = f->g;
    bool bones = g->s->part_count > 0, skin = g->s->skin_before != NULL;
    if ((bones && !gallery_bones(g, false, e)) || (skin && !gallery_skin(g, false, e))) return false;
    layer *layers = NEW_ARRAY(layer, g->s->part_count + 1);
    int count = 0;
    for (int i = 0; i < g->s->part_count; i++) {
        layers[count] = layer_default(g->bone[0][i], MATERIAL_BONE);
        layers[count++].move = g->s->parts[i].before;
    }
    if (skin) {
        layers[count] = layer_default(g->skin[0], MATERIAL_SKIN);
        layers[count++].opacity = 0.25;
    }
    picture p = {.layers = layers, .layer_count = count, .view = f->view};
    picture_style style = picture_style_default();
    style.width = f->width;
    style.height = f->height;
    for (int k = 0; k < 3; k++) style.background_top[k] = style.background_bottom[k] = 1;
    bool ok = picture_render(g->room, &p, &style, out, NULL, e);
    free(layers);
    if (!ok) return false;
    for (size_t i = 0; i < 4 * (size_t)out->width * (size_t)out->height; i++)
        if (i % 4 != 3) out->rgba[i] = (uint8_t)(255 - fade * (255 - out->rgba[i]) + 0.5);
    return true;
}

/* The whole table has sixty rows: here are those that the plan changes, and the ones everybody asks for. */
static bool has_row(int measure, const ceph_value *was, const ceph_value *is)
{
    static const char *const always[] = {"SNA", "SNB", "ANB", "FMA", "U1-FH", "IMPA", "Wits", "overjet", "overbite"};
    if (!isfinite(was[measure].value)) return false;
    if (fabs(is[measure].value - was[measure].value) >= 0.05) return true;
    for (size_t i = 0; i < sizeof always / sizeof *always; i++)
        if (!strcmp(ceph_measures[measure].name, always[i])) return true;
    return false;
}

static void norm_text(const ceph_norm *n, char text[32])
{
    text[0] = 0;
    if (isfinite(n->mean)) snprintf(text, 32, "%.1f ± %.1f", n->mean, n->sd);
}

static void draw_table(const profile *f, pen *p, double x, double right, int height)
{
    const subject *s = f->g->s;
    char sex = f->g->style->sex;
    ceph_value was[CEPH_MEASURES_MAX], is[CEPH_MEASURES_MAX];
    ceph_evaluate(s->before, &s->frame, was);
    ceph_evaluate(s->after, &s->frame, is);
    int rows = 3;
    const char *group = "";
    for (int i = 0; i < ceph_measure_count; i++) {
        if (!has_row(i, was, is)) continue;
        rows += 1 + (strcmp(group, ceph_measures[i].group) != 0);
        group = ceph_measures[i].group;
    }
    double step = fmin((height - 2.0 * f->size) / rows, 1.3 * f->size), size = step / 1.28, y = step + 0.4 * f->size;
    double norm = sex ? 8.5 * size : 15.6 * size,
           column[3] = {right - norm - 10 * size, right - norm - 4.8 * size, right - norm};
    static const char *const head[] = {"before", "planned", "change"};
    for (int k = 0; k < 3; k++)
        pen_text(p, column[k], y, LABEL_RIGHT, size, true, k < 2 ? profile_rgb[k] : ink, head[k]);
    group = "";
    bool substitute = false;
    if (sex != 'm')
        pen_text(p, sex ? right : right - 7.8 * size, y, LABEL_RIGHT, size, true, ink, sex ? "norm, women" : "women");
    if (sex != 'f') pen_text(p, right, y, LABEL_RIGHT, size, true, ink, sex ? "norm, men" : "men");
    for (int i = 0; i < ceph_measure_count; i++) {
        const ceph_measure *m = ceph_measures + i;
        char text[32], women[32], men[32];
        if (!has_row(i, was, is)) continue;
        if (strcmp(m->group, group)) {
            group = m->group;
            y += step;
            pen_line(p, x, y + 0.3 * size, right, y + 0.3 * size, 1, rule);
            pen_text(p, x, y, LABEL_LEFT, size, true, ink, m->group);
        }
        y += step;
        snprintf(text, sizeof text, "%s, %s%s", m->name, strcmp(m->unit, "deg") ? m->unit : "°",
                 *was[i].note ? " *" : "");
        substitute |= *was[i].note != 0;
        pen_text(p, x + 0.8 * size, y, LABEL_LEFT, size, false, ink, text);
        double change = is[i].value - was[i].value,
               value[3] = {was[i].value, is[i].value, fabs(change) < 0.05 ? 0 : change};
        for (int k = 0; k < 3; k++) {
            bool none = fabs(value[k]) < 0.05; /* no "-0.0" */
            snprintf(text, sizeof text, k < 2 || none ? "%.1f" : "%+.1f", none ? 0 : value[k]);
            pen_text(p, column[k], y, LABEL_RIGHT, size, k == 2 && fabs(change) >= 0.05,
                     k == 2 && fabs(change) < 0.05 ? faint : ink, text);
        }
        norm_text(&m->women, women);
        norm_text(&m->men, men);
        if (sex != 'm') pen_text(p, sex ? right : right - 7.8 * size, y, LABEL_RIGHT, size, false, faint, women);
        if (sex != 'f') pen_text(p, right, y, LABEL_RIGHT, size, false, faint, men);
    }
    pen_text(p, x, y += 1.5 * step, LABEL_LEFT, 0.85 * size, false, faint,
             substitute ? "What the plan changes, of all measures. * a neighbour stands for a missing landmark."
                        : "What the plan changes, of all measures.");
}

bool tracing_draw(gallery *g, int width, int height, image *out, err *e)
{
    bool beside = profile_has_table(g, width, height);
    int plot_width = beside ? (int)(width - 0.74 * height) : width;
    profile f;
    image im = {0}, plot = {0};
    if (!profile_open(g, framed, margin_mm, plot_width, height, &f, e) || !draw_ground(&f, &plot, e)) return false;
    bool ok = pen_open(&plot, &g->style->fonts, &f.p, e);
    if (ok) {
        for (int after = 0; after < 2; after++) {
            profile_bones(&f, after, 0.07 * f.size);
            profile_skin(&f, after, 0.16 * f.size);
            draw_planes(&f, after);
        }
        draw_dots(&f);
        if (g->style->labels) {
            label_entry entry[3] = {{"before", {0}}, {"planned", {0}}, {"unchanged", {0}}};
            for (int k = 0; k < 3; k++) vec_copy(k < 2 ? profile_rgb[k] : profile_same_rgb, entry[k].rgb);
            label_legend(f.p, 0.9 * f.size, 0.9 * f.size, 0.85 * f.size, entry, 3);
            double scale = camera_scale(&f.view, height);
            label_sides(f.p, 0, 0, plot_width, height, f.size, &f.view, &g->s->frame);
            label_scale_bar(f.p, 0.9 * f.size, height - f.size, scale, label_scale_length(scale, plot_width),
                            0.8 * f.size);
        }
        pen_close(&f.p);
        im = image_new(width, height);
        image_fill(&im, (const double[3]){1, 1, 1});
        image_paste(&im, &plot, 0, 0);
    }
    if (ok && beside) {
        pen *p = NULL;
        ok = pen_open(&im, &g->style->fonts, &p, e);
        if (ok) draw_table(&f, p, plot_width + 0.6 * f.size, width - f.size, height);
        pen_close(&p);
    }
    image_free(&plot);
    if (ok)
        *out = im;
    else
        image_free(&im);
    return ok;
}
