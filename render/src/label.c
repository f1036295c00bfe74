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
    if (FT_Init_FreeType(&p->library)) return err_set(e, ERR_RESOURCE, "no labels: FreeType cannot be set up");
    for (int i = 0; i < 2; i++) {
        if (FT_New_Face(p->library, path[i], 0, &p->face[i])) {
            p->face[i] = NULL;
            return err_set(e, ERR_RESOURCE,
                           "no labels: the font %s is missing or not a font (package fonts-dejavu-core)", path[i]);
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
    cairo_set_line_cap(p->cr, CAIRO_LINE_CAP_ROUND); /* pieces of a curve join without a gap */
    cairo_move_to(p->cr, x0, y0);
    cairo_line_to(p->cr, x1, y1);
    cairo_stroke(p->cr);
}

void pen_dot(pen *p, double x, double y, double radius, const double rgb[3])
{
    cairo_set_source_rgb(p->cr, paper[0], paper[1], paper[2]);
    cairo_arc(p->cr, x, y, radius + fmax(1, 0.25 * radius), 0, 2 * M_PI);
    cairo_fill(p->cr);
    cairo_set_source_rgb(p->cr, rgb[0], rgb[1], rgb[2]);
    cairo_arc(p->cr, x, y, radius, 0, 2 * M_PI);
    cairo_fill(p->cr);
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
    x = floor(x);
    y = floor(y);
    for (int column = 0; column < (int)width; column++) {
        double t = (column + 0.5) / width, rgb[3];
        colormap_color(m->map, m->low + t * (m->high - m->low), m->low, m->high, rgb);
        /* mixed in linear light, as the shader does */
        for (int k = 0; fade > 0 && t < fade && k < 3; k++)
            rgb[k] =
                colormap_encode((1 - t / fade) * colormap_linear(m->fade_rgb[k]) + t / fade * colormap_linear(rgb[k]));
        pen_box(p, x + column, y, 1, height, rgb, 1);
    }
    cairo_set_source_rgb(p->cr, ink[0], ink[1], ink[2]);
    cairo_set_line_width(p->cr, 1);
    cairo_rectangle(p->cr, x - 0.5, y - 0.5, floor(width) + 1, height + 1);
    cairo_stroke(p->cr);
    /* About five steps of a round size. */
    double step = colormap_nice_ceiling((m->high - m->low) / 5 * (1 - 1e-9));
    for (double v = ceil(m->low / step - 1e-9) * step; v <= m->high + 1e-9 * step; v += step) {
        double at = x + width * (v - m->low) / (m->high - m->low);
        char text[32];
        snprintf(text, sizeof text, m->low < 0 && fabs(v) > 1e-9 * step ? "%+g" : "%g", fabs(v) < 1e-9 * step ? 0 : v);
        pen_box(p, floor(at), y - 0.35 * size, 1, 0.35 * size, ink, 1);
        pen_text(p, at, y - 0.55 * size, LABEL_CENTRE, size, false, ink, text);
    }
}

void label_sides(pen *p, double x, double y, double width, double height, double size, const camera *c,
                 const head_frame *frame)
{
    /* R red, L blue: the two are told apart at a glance, and by the letter without colour. */
    static const double right_rgb[3] = {0.72, 0.27, 0.25}, left_rgb[3] = {0.18, 0.40, 0.66};
    double across = vec_dot(frame->left, c->right), toward = vec_dot(frame->left, c->back), r = 0.85 * size;
    if (fabs(across) > 0.3) {
        bool left_on_right = across > 0;
        pen_badge(p, x + 1.7 * r, y + height / 2, r, left_on_right ? right_rgb : left_rgb, left_on_right ? "R" : "L");
        pen_badge(p, x + width - 1.7 * r, y + height / 2, r, left_on_right ? left_rgb : right_rgb,
                  left_on_right ? "L" : "R");
    } else if (fabs(toward) > 0.3) {
        pen_badge(p, x + 1.7 * r, y + height / 2, r, toward > 0 ? left_rgb : right_rgb, toward > 0 ? "L" : "R");
    }
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
