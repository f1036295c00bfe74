#include "render/src/chart_plane.h"
#include "geometry/mem.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ink[3] = {0.16, 0.19, 0.23}, paper[3] = {1, 1, 1}, grey[3] = {0.45, 0.47, 0.50};
static const double legend_share = 0.40; /* of the width */

struct layout {
    double size;                     /* of the text */
    double left, top, width, height; /* of the plane */
    double per_x, per_y;             /* pixels per node */
    double legend_x, legend_width;
};

/* 1, 2 or 5 times a power of ten, for about `parts` ticks. */
static double tick_step(double range, int parts)
{
    double power = pow(10, floor(log10(range / parts))), rest = range / parts / power;
    return power * (rest <= 1 ? 1 : rest <= 2 ? 2 : rest <= 5 ? 5 : 10);
}

static double pixel_x(const chart *c, const struct layout *l, double x)
{
    return l->left + (x - c->x.low) / (c->x.step * (c->x.count - 1)) * l->width;
}

static double pixel_y(const chart *c, const struct layout *l, double y)
{
    return l->top + l->height - (y - c->y.low) / (c->y.step * (c->y.count - 1)) * l->height;
}

static void draw_axes(const chart *c, const struct layout *l, pen *p)
{
    for (int k = 0; k < 2; k++) {
        const chart_axis *a = k ? &c->y : &c->x;
        double high = a->low + a->step * (a->count - 1), step = tick_step(high - a->low, 9);
        for (double v = ceil(a->low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) {
            char text[32];
            bool zero = fabs(v) < 1e-9 * step;
            snprintf(text, sizeof text, "%g", zero ? 0 : v);
            double x = pixel_x(c, l, v), y = pixel_y(c, l, v), wide = zero ? 1.6 : 0.5;
            if (k) {
                pen_line(p, l->left, y, l->left + l->width, y, wide, grey);
                pen_line(p, l->left - 0.4 * l->size, y, l->left, y, 1.2, ink);
                pen_text(p, l->left - 0.6 * l->size, y + 0.36 * l->size, LABEL_RIGHT, l->size, false, ink, text);
            } else {
                pen_line(p, x, l->top, x, l->top + l->height, wide, grey);
                pen_line(p, x, l->top + l->height, x, l->top + l->height + 0.4 * l->size, 1.2, ink);
                pen_text(p, x, l->top + l->height + 1.5 * l->size, LABEL_CENTRE, l->size, false, ink, text);
            }
        }
    }
    double right = l->left + l->width, bottom = l->top + l->height;
    pen_line(p, l->left, l->top, right, l->top, 1.2, ink);
    pen_line(p, l->left, bottom, right, bottom, 1.2, ink);
    pen_line(p, l->left, l->top, l->left, bottom, 1.2, ink);
    pen_line(p, right, l->top, right, bottom, 1.2, ink);
    pen_text(p, l->left + l->width / 2, bottom + 3 * l->size, LABEL_CENTRE, l->size, true, ink, c->x.title);
    pen_text(p, l->left - 2.6 * l->size, l->top - 0.7 * l->size, LABEL_LEFT, l->size, true, ink, c->y.title);
}

/* Nodes of one patch (same kind, joined along the axes), and how deep in it each lies; returns the deepest. */
static int64_t find_patch(const chart *c, int64_t start, uint8_t *taken, int *deep, int64_t *count)
{
    int nx = c->x.count, ny = c->y.count;
    int64_t total = (int64_t)nx * ny, head = 0, tail = 0, best = start, *queue = NEW_ARRAY(int64_t, total);
    for (int64_t i = 0; i < total; i++) deep[i] = 0;
    queue[tail++] = start;
    taken[start] = 1;
    deep[start] = 1 << 20;
    while (head < tail) {
        int64_t at = queue[head++];
        int i = (int)(at % nx), k = (int)(at / nx);
        for (int s = 0; s < 4; s++) {
            int p = i + (s == 0) - (s == 1), q = k + (s == 2) - (s == 3);
            if (p < 0 || q < 0 || p >= nx || q >= ny || taken[chart_node(c, p, q)] ||
                c->kind[chart_node(c, p, q)] != c->kind[start])
                continue;
            taken[chart_node(c, p, q)] = 1;
            deep[chart_node(c, p, q)] = 1 << 20;
            queue[tail++] = chart_node(c, p, q);
        }
    }
    *count = tail;
    for (bool changed = true; changed;) {
        changed = false;
        for (int64_t n = 0; n < tail; n++) {
            int64_t at = queue[n];
            int i = (int)(at % nx), k = (int)(at / nx), least = 1 << 20;
            for (int s = 0; s < 4; s++) {
                int p = i + (s == 0) - (s == 1), q = k + (s == 2) - (s == 3);
                int other = p < 0 || q < 0 || p >= nx || q >= ny ? 0 : deep[chart_node(c, p, q)];
                least = other < least ? other : least;
            }
            if (least + 1 < deep[at]) {
                deep[at] = least + 1;
                changed = true;
            }
        }
    }
    for (int64_t n = 0; n < tail; n++) best = deep[queue[n]] > deep[best] ? queue[n] : best;
    free(queue);
    return best;
}

static void draw_letters(const chart *c, const struct layout *l, pen *p)
{
    int64_t total = (int64_t)c->x.count * c->y.count, count;
    uint8_t *taken = NEW_ARRAY(uint8_t, total);
    int *deep = NEW_ARRAY(int, total), written = 0;
    double(*at)[2] = mem_alloc((size_t)total, sizeof *at);
    for (int64_t start = 0; start < total; start++) {
        if (taken[start]) continue;
        int64_t best = find_patch(c, start, taken, deep, &count);
        const chart_kind *kind = &c->kinds[c->kind[start]];
        if (!kind->letter[0] || count < 6) continue;
        double x = pixel_x(c, l, c->x.low + c->x.step * (double)(best % c->x.count)),
               y = pixel_y(c, l, c->y.low + c->y.step * (double)(best / c->x.count)), r = 0.62 * l->size;
        x = fmin(fmax(x, l->left + r), l->left + l->width - r);
        y = fmin(fmax(y, l->top + r), l->top + l->height - r);
        bool covered = false; /* by another letter or a mark */
        for (int i = 0; i < written; i++) covered |= hypot(at[i][0] - x, at[i][1] - y) < 2.2 * r;
        for (int i = 0; i < c->mark_count; i++)
            covered |= hypot(pixel_x(c, l, c->marks[i].x) - x, pixel_y(c, l, c->marks[i].y) - y) < 2.2 * r;
        if (covered) continue;
        pen_badge(p, x, y, r, ink, kind->letter);
        at[written][0] = x;
        at[written++][1] = y;
    }
    free(at);
    free(taken);
    free(deep);
}

static void draw_mark(pen *p, double x, double y, double r, chart_symbol symbol)
{
    if (symbol == CHART_CROSS) {
        for (int k = 0; k < 2; k++) {
            const double *rgb = k ? ink : paper, wide = k ? 3 : 7, out = k ? r : r + 2;
            pen_line(p, x - out, y, x + out, y, wide, rgb);
            pen_line(p, x, y - out, x, y + out, wide, rgb);
        }
        return;
    }
    pen_badge(p, x, y, r + 3, paper, "");
    pen_badge(p, x, y, r, ink, "");
    if (symbol == CHART_RING) pen_badge(p, x, y, 0.6 * r, paper, "");
}

/* Writes the text in lines of at most `width`; returns the base line of the last one. */
static double wrap(pen *p, double x, double y, double width, double size, const double rgb[3], const char *text)
{
    char line[512] = "", *copy = mem_text(text), *rest = NULL;
    for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
        char longer[1024];
        snprintf(longer, sizeof longer, "%s%s%s", line, *line ? " " : "", word);
        if (*line && pen_text_width(p, size, false, longer) > width) {
            pen_text(p, x, y, LABEL_LEFT, size, false, rgb, line);
            y += 1.3 * size;
            snprintf(longer, sizeof longer, "%s", word);
        }
        snprintf(line, sizeof line, "%.511s", longer);
    }
    pen_text(p, x, y, LABEL_LEFT, size, false, rgb, line);
    free(copy);
    return y;
}

/* Swatches are pixels, texts a pen's: the first pass finds where they go. Returns the height used. */
static double draw_legend(const chart *c, const struct layout *l, pen *p, image *swatches, double top)
{
    double y = top, x = l->legend_x, text_x = x + 2.2 * l->size, width = l->legend_width - 2.2 * l->size;
    double side = 1.5 * l->size;
    for (int i = 0; i < c->kind_count; i++) {
        const chart_kind *kind = &c->kinds[i];
        if (!kind->text) continue;
        if (swatches) chart_plane_swatch(kind, (int)x, (int)y, (int)side, l->size, swatches);
        if (kind->letter[0]) pen_badge(p, x + side / 2, y + side / 2, 0.62 * l->size, ink, kind->letter);
        y = wrap(p, text_x, y + 1.1 * l->size, width, l->size, ink, kind->text) + 0.9 * l->size;
    }
    if (c->veil_text) {
        pen_text(p, x + side / 2, y + 1.1 * l->size, LABEL_CENTRE, 1.2 * l->size, true, grey, "\xE2\x96\xA6");
        y = wrap(p, text_x, y + 1.1 * l->size, width, l->size, ink, c->veil_text) + 0.9 * l->size;
    }
    for (int i = 0; i < c->mark_count; i++) {
        if (!c->marks[i].text) continue;
        draw_mark(p, x + side / 2, y + side / 2, 0.45 * l->size, c->marks[i].symbol);
        y = wrap(p, text_x, y + 1.1 * l->size, width, l->size, ink, c->marks[i].text) + 0.9 * l->size;
    }
    y += 0.6 * l->size;
    for (int i = 0; i < c->note_count; i++)
        y = wrap(p, x, y + l->size, l->legend_width, 0.85 * l->size, grey, c->notes[i]) + 0.6 * l->size;
    return y - top;
}

static struct layout lay_out(const chart *c, int width, bool same_scale)
{
    struct layout l = {.size = floor(width / 75.0)};
    l.left = floor(4.5 * l.size);
    l.top = floor(6.6 * l.size);
    l.legend_width = floor(legend_share * width) - 2 * l.size;
    l.width = floor(width * (1 - legend_share) - l.left);
    l.height = l.width;
    if (same_scale) {
        double x = c->x.step * (c->x.count - 1), y = c->y.step * (c->y.count - 1);
        if (y <= 1.25 * x)
            l.height = floor(l.width * y / x);
        else {
            l.height = floor(1.25 * l.width);
            l.width = floor(l.height * x / y);
        }
        l.height = fmax(l.height, 8 * l.size);
    }
    l.legend_x = floor(width * (1 - legend_share) + 1.2 * l.size);
    return l;
}

bool chart_draw(const chart *c, int width, bool same_scale, image *out, err *e)
{
    assert(c->x.count > 1 && c->y.count > 1 && width >= 600);
    struct layout l = lay_out(c, width, same_scale);
    label_fonts fonts = label_fonts_default();
    pen *p = NULL;
    image probe = image_new(8, 8);
    bool ok = pen_open(&probe, &fonts, &p, e);
    double legend = ok ? draw_legend(c, &l, p, NULL, l.top) : 0;
    pen_close(&p);
    image_free(&probe);
    if (!ok) return false;
    int height = (int)fmax(l.top + l.height + 4.2 * l.size, l.top + legend + l.size);
    image im = image_new(width, height);
    image_fill(&im, paper);
    chart_plane_draw(c, (int)l.left, (int)l.top, (int)l.width, (int)l.height, l.size, &im);
    for (int pass = 0; ok && pass < 2; pass++) { /* swatches need the image between two pens */
        image blank = image_new(8, 8);
        ok = pen_open(pass ? &im : &blank, &fonts, &p, e);
        if (ok && !pass) draw_legend(c, &l, p, &im, l.top);
        if (ok && pass) {
            draw_legend(c, &l, p, NULL, l.top);
            draw_axes(c, &l, p);
            draw_letters(c, &l, p);
            for (int i = 0; i < c->mark_count; i++)
                draw_mark(p, pixel_x(c, &l, c->marks[i].x), pixel_y(c, &l, c->marks[i].y), 0.5 * l.size,
                          c->marks[i].symbol);
            pen_text(p, l.left - 2.6 * l.size, 2 * l.size, LABEL_LEFT, 1.5 * l.size, true, ink, c->title);
            if (c->subtitle)
                pen_text(p, l.left - 2.6 * l.size, 3.6 * l.size, LABEL_LEFT, l.size, false, grey, c->subtitle);
        }
        pen_close(&p);
        image_free(&blank);
    }
    if (ok)
        *out = im;
    else
        image_free(&im);
    return ok;
}
