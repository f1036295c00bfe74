/* The two profiles over a grid of millimetres, and how far the landmarks of the skin move. */
#include "render/src/profile.h"
#include "geometry/vec.h"
#include <stdio.h>

static const double ink[3] = {0.16, 0.19, 0.23}, faint[3] = {0.45, 0.49, 0.54}, paper[3] = {0.985, 0.988, 0.992};
static const double grid_rgb[2][3] = {{0.91, 0.925, 0.94}, {0.80, 0.835, 0.87}}, axis_rgb[3] = {0.42, 0.50, 0.58};
static const char *const shown[] = {"G'",   "N'",      "Pn", "Sn",  "A'",  "Ls",  "Stm", "Stms",
                                    "Stmi", "Li_soft", "B'", "Pg'", "Gn'", "Me'", "C",   NULL};
static const char *const framed[] = {"N'", "Pn", "Sn", "Pg'", "Me'", "G'", NULL};
static const double margin_mm = 14, minor_mm = 5;

/* Zero of the grid: subnasale before; the vertical through it is the true vertical line. */
static void draw_grid(const profile *f, const double zero[3])
{
    double scale = camera_scale(&f->view, f->height), zx, zy, unused;
    camera_project(&f->view, f->width, f->height, zero, &zx, &zy, &unused);
    for (int across = 0; across < 2; across++) {
        double at = across ? zy : zx, end = across ? f->height : f->width, step = minor_mm * scale;
        int first = -(int)(at / step), last = (int)((end - at) / step);
        for (int pass = 0; pass < 2; pass++) /* the finer lines below the others */
            for (int i = first; i <= last; i++) {
                bool major = i % 2 == 0;
                double q = floor(at + i * step) + 0.5;
                if (major != pass) continue;
                const double *rgb = i ? grid_rgb[major] : axis_rgb;
                if (across)
                    pen_line(f->p, 0, q, f->width, q, 1, rgb);
                else
                    pen_line(f->p, q, 0, q, f->height, i ? 1 : 2, rgb);
                if (!major || !f->g->style->labels) continue;
                char text[32];
                /* forward is to the left, up is up */
                snprintf(text, sizeof text, "%+g", i ? -i * minor_mm : 0);
                if (across)
                    pen_text(f->p, f->width - 0.5 * f->size, q - 3, LABEL_RIGHT, 0.7 * f->size, false, faint,
                             i ? text : "0");
                else
                    pen_text(f->p, q + 3, f->height - 0.4 * f->size, LABEL_LEFT, 0.7 * f->size, false, faint,
                             i ? text : "0");
            }
    }
    if (f->g->style->labels)
        pen_text(f->p, zx - 0.4 * f->size, f->height - 2.0 * f->size, LABEL_RIGHT, 0.75 * f->size, false, axis_rgb,
                 "vertical through Sn");
}

static void draw_points(const profile *f)
{
    double before[3], after[3];
    label_point names[sizeof shown / sizeof *shown];
    int count = 0;
    for (int i = 0; shown[i]; i++) {
        if (!profile_point(f, false, shown[i], before) || !profile_point(f, true, shown[i], after)) continue;
        bool same = vec_distance(before, after) < 0.1;
        profile_line(f, before, after, 0.12 * f->size, ink);
        profile_dot(f, before, 0.22 * f->size, same ? profile_same_rgb : profile_rgb[0]);
        if (!same) profile_dot(f, after, 0.22 * f->size, profile_rgb[1]);
        names[count].text = shown[i];
        vec_copy(after, names[count++].xyz);
    }
    if (f->g->style->labels) label_column(f->p, f->width, f->height, 0.85 * f->size, &f->view, names, count);
}

static void draw_table(const profile *f, pen *p, double x, double right)
{
    const head_frame *frame = &f->g->s->frame;
    double size = 1.0 * f->size, y = 3.2 * size,
           column[3] = {right - 9.2 * size, right - 4.7 * size, right - 0.6 * size};
    static const char *const head[] = {"forward", "up", "total"};
    pen_text(p, x, y, LABEL_LEFT, size, true, ink, "Skin moves by, mm");
    for (int k = 0; k < 3; k++) pen_text(p, column[k], y + 1.9 * size, LABEL_RIGHT, 0.85 * size, false, faint, head[k]);
    y += 2.4 * size;
    pen_line(p, x, y, right, y, 1, grid_rgb[1]);
    for (int i = 0; shown[i]; i++) {
        double before[3], after[3], d[3];
        if (!profile_point(f, false, shown[i], before) || !profile_point(f, true, shown[i], after)) continue;
        char text[32];
        vec_sub(after, before, d);
        double value[3] = {-vec_dot(d, frame->posterior), vec_dot(d, frame->up), vec_norm(d)};
        y += 1.65 * size;
        pen_text(p, x, y, LABEL_LEFT, size, false, ink, shown[i]);
        for (int k = 0; k < 3; k++) {
            bool none = fabs(value[k]) < 0.05;
            snprintf(text, sizeof text, k < 2 && !none ? "%+.1f" : "%.1f", none ? 0 : value[k]);
            pen_text(p, column[k], y, LABEL_RIGHT, size, false, ink, text);
        }
    }
    y += 1.4 * size;
    static const char *const note[] = {"Curves: the skin where the midsagittal",
                                       "plane cuts it. Grid: 5 and 10 mm from",
                                       "subnasale before, in the Frankfort frame."};
    for (int i = 0; i < 3; i++) pen_text(p, x, y += 1.3 * size, LABEL_LEFT, 0.8 * size, false, faint, note[i]);
}

bool contour_draw(gallery *g, int width, int height, image *out, err *e)
{
    bool beside = profile_has_table(g, width, height);
    int plot_width = beside ? (int)(width - 19.5 * profile_text_size(height)) : width;
    profile f;
    if (!profile_open(g, framed, margin_mm, plot_width, height, &f, e)) return false;
    image im = image_new(width, height), plot = image_new(plot_width, height);
    double zero[3];
    image_fill(&plot, paper);
    image_fill(&im, (const double[3]){1, 1, 1});
    bool ok = pen_open(&plot, &g->style->fonts, &f.p, e);
    if (ok) {
        if (!profile_point(&f, false, "Sn", zero)) vec_copy(f.view.target, zero);
        draw_grid(&f, zero);
        for (int after = 0; after < 2; after++) profile_skin(&f, after, 0.17 * f.size);
        draw_points(&f);
        if (g->style->labels) {
            label_entry entry[3] = {{"before", {0}}, {"predicted", {0}}, {"unchanged", {0}}};
            for (int k = 0; k < 3; k++) vec_copy(k < 2 ? profile_rgb[k] : profile_same_rgb, entry[k].rgb);
            label_legend(f.p, 0.9 * f.size, 0.9 * f.size, 0.85 * f.size, entry, 3);
            label_sides(f.p, 0, 0, plot_width, height, f.size, &f.view, &g->s->frame);
        }
        pen_close(&f.p);
        image_paste(&im, &plot, 0, 0);
    }
    if (ok && beside) {
        pen *p = NULL;
        ok = pen_open(&im, &g->style->fonts, &p, e);
        if (ok) draw_table(&f, p, plot_width + f.size, width - f.size);
        pen_close(&p);
    }
    image_free(&plot);
    if (ok)
        *out = im;
    else
        image_free(&im);
    return ok;
}
