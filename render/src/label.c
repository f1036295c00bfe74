/* Cairo draws premultiplied native-endian ARGB; images here are straight RGBA bytes. */
#include "render/label.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <cairo-ft.h>
#include <cairo.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double ink[3] = {0.16, 0.19, 0.23};
static const double paper[3] = {1, 1, 1};

struct pen {
    image *im;
    FT_Library library;
    FT_Face face[2];
    cairo_font_face_t *font[2];
    cairo_surface_t *surface;
    cairo_t *cr;
};

label_fonts label_fonts_default(void)
{
    return (label_fonts){"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                         "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};
}

static void to_cairo(pen *p)
{
    unsigned char *data = cairo_image_surface_get_data(p->surface);
    size_t stride = (size_t)cairo_image_surface_get_stride(p->surface);
    for (int y = 0; y < p->im->height; y++) {
        uint32_t *row = (uint32_t *)(void *)(data + (size_t)y * stride);
        const uint8_t *from = image_pixel(p->im, 0, y);
        for (int x = 0; x < p->im->width; x++, from += 4) {
            uint32_t a = from[3], c[3];
            for (int k = 0; k < 3; k++) c[k] = (from[k] * a + 127) / 255;
            row[x] = a << 24 | c[0] << 16 | c[1] << 8 | c[2];
        }
    }
    cairo_surface_mark_dirty(p->surface);
}

static void from_cairo(pen *p)
{
    cairo_surface_flush(p->surface);
    const unsigned char *data = cairo_image_surface_get_data(p->surface);
    size_t stride = (size_t)cairo_image_surface_get_stride(p->surface);
    for (int y = 0; y < p->im->height; y++) {
        const uint32_t *row = (const uint32_t *)(const void *)(data + (size_t)y * stride);
        uint8_t *to = image_pixel(p->im, 0, y);
        for (int x = 0; x < p->im->width; x++, to += 4) {
            uint32_t a = row[x] >> 24;
            for (int k = 0; k < 3; k++) {
                uint32_t c = row[x] >> (16 - 8 * k) & 255;
                to[k] = (uint8_t)(a ? (c * 255 + a / 2) / a : 0);
            }
            to[3] = (uint8_t)a;
        }
    }
}

static void release(pen *p)
{
    if (p->cr) cairo_destroy(p->cr);
    if (p->surface) cairo_surface_destroy(p->surface);
    for (int i = 0; i < 2; i++) {
        if (p->font[i]) cairo_font_face_destroy(p->font[i]);
        if (p->face[i]) FT_Done_Face(p->face[i]);
    }
    if (p->library) FT_Done_FreeType(p->library);
    free(p);
}

static bool set_up(pen *p, const label_fonts *fonts, err *e)
{
    const char *path[2] = {fonts->regular, fonts->bold};
    if (FT_Init_FreeType(&p->library))
        return err_set(e, ERR_RESOURCE, "no labels: FreeType cannot be set up");
    for (int i = 0; i < 2; i++) {
        if (FT_New_Face(p->library, path[i], 0, &p->face[i])) {
            p->face[i] = NULL;
            return err_set(e, ERR_RESOURCE,
                           "no labels: the font %s is missing or not a font (package fonts-dejavu-core)",
                           path[i]);
        }
        p->font[i] = cairo_ft_font_face_create_for_ft_face(p->face[i], FT_LOAD_NO_HINTING);
    }
    p->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, p->im->width, p->im->height);
    p->cr = cairo_create(p->surface);
    if (cairo_status(p->cr) != CAIRO_STATUS_SUCCESS)
        return err_set(e, ERR_RESOURCE, "no labels: %s", cairo_status_to_string(cairo_status(p->cr)));
    cairo_font_options_t *o = cairo_font_options_create();
    cairo_font_options_set_antialias(o, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(o, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(o, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(p->cr, o);
    cairo_font_options_destroy(o);
    return true;
}

bool pen_open(image *im, const label_fonts *fonts, pen **out, err *e)
{
    pen *p = mem_alloc(1, sizeof *p);
    p->im = im;
    if (!set_up(p, fonts, e)) {
        release(p);
        return false;
    }
    to_cairo(p);
    *out = p;
    return true;
}

void pen_close(pen **p)
{
    if (!*p) return;
    from_cairo(*p);
    release(*p);
    *p = NULL;
}

static void use_font(pen *p, double size, bool bold)
{
    cairo_set_font_face(p->cr, p->font[bold]);
    cairo_set_font_size(p->cr, size);
}

double pen_text_width(pen *p, double size, bool bold, const char *text)
{
    cairo_text_extents_t t;
    use_font(p, size, bold);
    cairo_text_extents(p->cr, text, &t);
    return t.x_advance;
}

void pen_text(pen *p, double x, double y, label_align align, double size, bool bold, const double rgb[3],
              const char *text)
{
    double width = pen_text_width(p, size, bold, text);
    cairo_move_to(p->cr, x - (align == LABEL_RIGHT ? width : align == LABEL_CENTRE ? width / 2 : 0), y);
    cairo_set_source_rgb(p->cr, rgb[0], rgb[1], rgb[2]);
    cairo_show_text(p->cr, text);
    cairo_new_path(p->cr);
}

void pen_box(pen *p, double x, double y, double width, double height, const double rgb[3], double opacity)
{
    cairo_set_source_rgba(p->cr, rgb[0], rgb[1], rgb[2], opacity);
    cairo_rectangle(p->cr, x, y, width, height);
    cairo_fill(p->cr);
}

void pen_line(pen *p, double x0, double y0, double x1, double y1, double width, const double rgb[3])
{
    cairo_set_source_rgb(p->cr, rgb[0], rgb[1], rgb[2]);
    cairo_set_line_width(p->cr, width);
    cairo_move_to(p->cr, x0, y0);
    cairo_line_to(p->cr, x1, y1);
    cairo_stroke(p->cr);
}

void pen_badge(pen *p, double x, double y, double radius, const double rgb[3], const char *letter)
{
    cairo_set_source_rgba(p->cr, rgb[0], rgb[1], rgb[2], 0.92);
    cairo_arc(p->cr, x, y, radius, 0, 2 * M_PI);
    cairo_fill(p->cr);
    pen_text(p, x, y + 0.40 * radius, LABEL_CENTRE, 1.15 * radius, true, paper, letter);
}

double label_scale_length(double pixels_per_mm, int width)
{
    static const double lengths[] = {100, 50, 20, 10};
    for (int i = 0; i < 4; i++)
        if (3 * lengths[i] * pixels_per_mm <= width) return lengths[i];
    return 10;
}

void label_scale_bar(pen *p, double x, double y, double pixels_per_mm, double length_mm, double size)
{
    /* Edges on whole pixels: the bar can be counted in the picture. */
    double length = length_mm * pixels_per_mm, thick = fmax(2, floor(size / 7)), tick = floor(size * 0.55);
    x = floor(x);
    y = floor(y);
    pen_box(p, x, y, length, thick, ink, 1);
    int ticks = (int)(length_mm / 10 + 1e-9);
    for (int i = 1; i < ticks; i++)
        pen_box(p, x + i * 10 * pixels_per_mm - thick / 4, y - tick / 2, thick / 2, tick / 2, ink, 1);
    pen_box(p, x, y - tick, thick, tick, ink, 1);
    pen_box(p, x + length - thick, y - tick, thick, tick, ink, 1);
    char text[40];
    snprintf(text, sizeof text, "%g mm", length_mm);
    pen_text(p, x + length / 2, y - tick - 0.3 * size, LABEL_CENTRE, size, false, ink, text);
}

void label_color_bar(pen *p, double x, double y, double width, double height, double size, const label_map *m)
{
    double fade = (m->fade_end - m->low) / (m->high - m->low);
    for (int row = 0; row < (int)height; row++) {
        double t = 1 - (row + 0.5) / height, rgb[3];
        colormap_color(m->map, m->low + t * (m->high - m->low), m->low, m->high, rgb);
        /* mixed in linear light, as the shader does */
        for (int k = 0; fade > 0 && t < fade && k < 3; k++)
            rgb[k] = colormap_encode((1 - t / fade) * colormap_linear(m->fade_rgb[k]) +
                                     t / fade * colormap_linear(rgb[k]));
        pen_box(p, x, y + row, width, 1, rgb, 1);
    }
    cairo_set_source_rgb(p->cr, ink[0], ink[1], ink[2]);
    cairo_set_line_width(p->cr, 1);
    cairo_rectangle(p->cr, x - 0.5, y - 0.5, width + 1, height + 1);
    cairo_stroke(p->cr);
    /* About five steps of a round size. */
    double step = colormap_nice_ceiling((m->high - m->low) / 5 * (1 - 1e-9));
    for (double v = ceil(m->low / step - 1e-9) * step; v <= m->high + 1e-9 * step; v += step) {
        double at = y + height * (1 - (v - m->low) / (m->high - m->low));
        char text[32];
        snprintf(text, sizeof text, "%g", fabs(v) < 1e-9 * step ? 0 : v);
        pen_box(p, x - 0.35 * size, floor(at), 0.35 * size, 1, ink, 1);
        pen_text(p, x - 0.55 * size, at + 0.36 * size, LABEL_RIGHT, size, false, ink, text);
    }
    pen_text(p, x + width, y - 0.9 * size, LABEL_RIGHT, size, true, ink, m->caption);
}

void label_sides(pen *p, double x, double y, double width, double height, double size, const camera *c,
                 const head_frame *frame)
{
    /* R red, L blue: the two are told apart at a glance, and by the letter without colour. */
    static const double right_rgb[3] = {0.72, 0.27, 0.25}, left_rgb[3] = {0.18, 0.40, 0.66};
    double across = vec_dot(frame->left, c->right), toward = vec_dot(frame->left, c->back), r = 0.85 * size;
    if (fabs(across) > 0.3) {
        bool left_on_right = across > 0;
        pen_badge(p, x + 1.7 * r, y + height / 2, r, left_on_right ? right_rgb : left_rgb,
                  left_on_right ? "R" : "L");
        pen_badge(p, x + width - 1.7 * r, y + height / 2, r, left_on_right ? left_rgb : right_rgb,
                  left_on_right ? "L" : "R");
    } else if (fabs(toward) > 0.3) {
        pen_badge(p, x + 1.7 * r, y + height / 2, r, toward > 0 ? left_rgb : right_rgb,
                  toward > 0 ? "L" : "R");
    }
}

typedef struct placed {
    double x, y, at; /* point; base line of the name */
    int index;
} placed;

static int by_x(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    if (p->x < q->x || p->x > q->x) return p->x < q->x ? -1 : 1;
    return p->index - q->index;
}

static int by_y(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    if (p->y < q->y || p->y > q->y) return p->y < q->y ? -1 : 1;
    return p->index - q->index;
}

/* Heights as near as possible (least squares) to those of the points with `step` between them: isotonic
 * regression of y - i step by pooling neighbours that violate the order, then the borders. */
static void spread(placed *q, int n, double step, double low, double high)
{
    double *sum = NEW_ARRAY(double, n);
    int *size = NEW_ARRAY(int, n), blocks = 0;
    for (int i = 0; i < n; i++) {
        sum[blocks] = q[i].y - i * step;
        size[blocks++] = 1;
        while (blocks > 1 && sum[blocks - 2] / size[blocks - 2] > sum[blocks - 1] / size[blocks - 1]) {
            sum[blocks - 2] += sum[blocks - 1];
            size[blocks - 2] += size[blocks - 1];
            blocks--;
        }
    }
    for (int b = 0, i = 0; b < blocks; b++)
        for (int k = 0; k < size[b]; k++, i++)
            q[i].at = fmax(low, fmin(sum[b] / size[b], high - (n - 1) * step)) + i * step;
    free(sum);
    free(size);
}

void label_points(pen *p, const image *im, double size, const camera *c, const label_point *points, int count,
                  const uint8_t *seen)
{
    placed *all = NEW_ARRAY(placed, count);
    int n = 0;
    for (int i = 0; i < count; i++) {
        double near_mm;
        placed q = {.index = i};
        if (seen && !seen[i]) continue;
        camera_project(c, im->width, im->height, points[i].xyz, &q.x, &q.y, &near_mm);
        if (q.x >= 0 && q.y >= 0 && q.x < im->width && q.y < im->height) all[n++] = q;
    }
    /* Half of the names go to each border; they shrink where a column would be too long. */
    qsort(all, (size_t)n, sizeof *all, by_x);
    double low = 5 * size, high = im->height - 5 * size;
    for (int side = 0; side < 2; side++) {
        placed *q = all + (side ? n / 2 : 0);
        int m = side ? n - n / 2 : n / 2;
        double step = m > 1 ? fmin(1.3 * size, (high - low) / (m - 1)) : size, font = fmin(size, step / 1.1);
        qsort(q, (size_t)m, sizeof *q, by_y);
        spread(q, m, step, low, high);
        for (int i = 0; i < m; i++) {
            const char *text = points[q[i].index].text;
            double wide = pen_text_width(p, font, false, text),
                   edge = side ? im->width - 4.4 * size : 4.4 * size;
            double elbow = side ? edge - wide - 0.4 * size : edge + wide + 0.4 * size;
            pen_line(p, elbow, q[i].at - 0.35 * font, q[i].x, q[i].y, fmax(1, size / 16), ink);
            pen_text(p, edge, q[i].at, side ? LABEL_RIGHT : LABEL_LEFT, font, false, ink, text);
        }
    }
    free(all);
}

double label_legend(pen *p, double x, double y, double size, const label_entry *entries, int count)
{
    double step = 1.55 * size, side = 0.95 * size;
    for (int i = 0; i < count; i++) {
        double top = y + i * step;
        pen_box(p, x - 1, top - 1, side + 2, side + 2, ink, 0.55);
        pen_box(p, x, top, side, side, entries[i].rgb, 1);
        pen_text(p, x + 1.5 * size, top + 0.84 * size, LABEL_LEFT, size, false, ink, entries[i].text);
    }
    return count * step;
}
