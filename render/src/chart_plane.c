/* The plane is classified sub-pixel by sub-pixel, two by two, and halved. */
#include "render/src/chart_plane.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>

static const double ink[3] = {0.16, 0.19, 0.23}, grey[3] = {0.45, 0.47, 0.50};

static int rank_of(const chart *c, int i, int k) { return c->kinds[c->kind[chart_node(c, i, k)]].rank; }

/* Where between node (i, k) and the next one along the axis the rank changes, as seen from `from` (0 or 1). */
static double leg(const chart *c, int axis, int i, int k, int from)
{
    double share = c->crossing[axis] ? c->crossing[axis][chart_node(c, i, k)] : 0.5;
    return from ? 1 - share : share;
}

/* The point is nearer to the corner (a, b) of cell (i, k) than the line between the two crossings around it. */
static bool cut_off(const chart *c, int i, int k, int a, int b, double u, double v)
{
    double x = leg(c, 0, i, k + b, a), y = leg(c, 1, i + a, k, b);
    return x > 0 && y > 0 && (a ? 1 - u : u) / x + (b ? 1 - v : v) / y < 1;
}

/* On the side of the corners with rank >= least, in a cell that has both sides; of two ways across, theirs joins. */
static bool on_side(const chart *c, int i, int k, int least, double u, double v)
{
    bool f[2][2];
    int count = 0;
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) count += f[a][b] = rank_of(c, i + a, k + b) >= least;
    if (count == 2 && f[0][0] == f[0][1]) {
        double at = (1 - v) * leg(c, 0, i, k, 0) + v * leg(c, 0, i, k + 1, 0);
        return f[0][0] == (u < at);
    }
    if (count == 2 && f[0][0] == f[1][0]) {
        double at = (1 - u) * leg(c, 1, i, k, 0) + u * leg(c, 1, i + 1, k, 0);
        return f[0][0] == (v < at);
    }
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            if (f[a][b] == (count == 1) && cut_off(c, i, k, a, b, u, v)) return count == 1;
    return count != 1;
}

/* The node whose kind a place has: the nearest corner of the cell on its side of the lines. */
static int64_t owner(const chart *c, double x, double y)
{
    int i = (int)fmin(x, c->x.count - 2), k = (int)fmin(y, c->y.count - 2), low = 1 << 30, high = 0, mine = 0;
    double u = x - i, v = y - k, least = HUGE_VAL;
    for (int a = 0; a < 4; a++) {
        int r = rank_of(c, i + (a & 1), k + (a >> 1));
        low = r < low ? r : low;
        high = r > high ? r : high;
    }
    for (mine = high; mine > low; mine--) {
        bool there = false;
        for (int a = 0; a < 4; a++) there |= rank_of(c, i + (a & 1), k + (a >> 1)) == mine;
        if (there && on_side(c, i, k, mine, u, v)) break;
    }
    int64_t best = chart_node(c, i, k);
    for (int a = 0; a < 4; a++) {
        double d = hypot(u - (a & 1), v - (a >> 1));
        if (rank_of(c, i + (a & 1), k + (a >> 1)) != mine || d >= least) continue;
        least = d;
        best = chart_node(c, i + (a & 1), k + (a >> 1));
    }
    return best;
}

static void put(image *im, int x, int y, const double rgb[3])
{
    uint8_t *p = image_pixel(im, x, y);
    for (int k = 0; k < 3; k++) p[k] = (uint8_t)lround(255 * rgb[k]);
    p[3] = 255;
}

/* Colour of a kind at a sub-pixel. */
static void shade(const chart_kind *kind, int x, int y, double scale, double rgb[3])
{
    int period = (int)lround(14 * scale), a = (x % period) - period / 2, b = (y % period) - period / 2;
    bool dark = kind->pattern == CHART_DOTS      ? a * a + b * b < 5.0 * scale * scale
                : kind->pattern == CHART_STRIPES ? (x + y) % period < 2.6 * scale
                                                 : false;
    for (int k = 0; k < 3; k++) {
        double tint = kind->pattern == CHART_PLAIN ? kind->rgb[k] : 1 - 0.38 * (1 - kind->rgb[k]);
        rgb[k] = dark ? kind->rgb[k] * 0.85 : tint;
    }
}

void chart_plane_draw(const chart *c, int left, int top, int width, int height, double size, image *to)
{
    int w = 2 * width, h = 2 * height;
    double scale = size / 10;
    image fine = image_new(w, h);
    int64_t *own = NEW_ARRAY(int64_t, (int64_t)w * h);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            own[(int64_t)y * w + x] = owner(c, (x + 0.5) / w * (c->x.count - 1), (h - y - 0.5) / h * (c->y.count - 1));
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            int64_t at = own[(int64_t)y * w + x];
            const chart_kind *kind = &c->kinds[c->kind[at]];
            double rgb[3];
            shade(kind, x, y, scale, rgb);
            if (c->veiled && c->veiled[at]) {
                int period = (int)lround(9 * scale);
                bool net = (x + y) % period < 1.4 * scale || (x - y + h) % period < 1.4 * scale;
                for (int k = 0; k < 3; k++) rgb[k] = net ? grey[k] : rgb[k];
            }
            /* the line lies on the side of the lower rank */
            int reach = 1 + (int)(0.18 * size), line = 0;
            for (int s = 0; s < 8; s++) {
                static const int dx[] = {1, -1, 0, 0, 1, 1, -1, -1}, dy[] = {0, 0, 1, -1, 1, -1, 1, -1};
                int p = x + dx[s] * reach, q = y + dy[s] * reach;
                if (p < 0 || q < 0 || p >= w || q >= h) continue;
                int other = c->kinds[c->kind[own[(int64_t)q * w + p]]].rank;
                line = other > kind->rank && other > line ? other : line;
            }
            if (line)
                for (int k = 0; k < 3; k++) rgb[k] = line > 1 ? ink[k] : grey[k];
            put(&fine, x, y, rgb);
        }
    image half = image_half(&fine);
    image_paste(to, &half, left, top);
    image_free(&half);
    image_free(&fine);
    free(own);
}

void chart_plane_swatch(const chart_kind *kind, int x, int y, int side, double size, image *to)
{
    image fine = image_new(2 * side, 2 * side);
    for (int b = 0; b < 2 * side; b++)
        for (int a = 0; a < 2 * side; a++) {
            double rgb[3];
            bool rim = a < 2 || b < 2 || a >= 2 * side - 2 || b >= 2 * side - 2;
            shade(kind, a, b, size / 10, rgb);
            put(&fine, a, b, rim ? grey : rgb);
        }
    image half = image_half(&fine);
    image_paste(to, &half, x, y);
    image_free(&half);
    image_free(&fine);
}
