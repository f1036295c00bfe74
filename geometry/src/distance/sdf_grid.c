#include "geometry/sdf_grid.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static size_t cell_index(const sdf_grid *g, int32_t i, int32_t j, int32_t k)
{
    return (size_t)i + (size_t)g->size[0] * ((size_t)j + (size_t)g->size[1] * (size_t)k);
}

static int32_t clamp_index(double v, int32_t size) { return v < 0 ? 0 : v > size - 1 ? size - 1 : (int32_t)v; }

/* Grid lines run along x at (j, k), shifted by an odd fraction of a step so that they miss vertices and edges of
 * surfaces that were themselves made on a grid. */
static const double line_shift[2] = {0.0173, 0.0291};

/* Adds, per grid line, +1 behind each crossing into the surface and -1 behind each crossing out of it. */
static void mark_crossings(sdf_grid *g, const surface *s, int16_t *change)
{
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const double *p[3];
        double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
        for (int k = 0; k < 3; k++) {
            p[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
            for (int c = 0; c < 2; c++) {
                double v = (p[k][c + 1] - g->low[c + 1]) / g->step_mm - line_shift[c];
                lo[c] = fmin(lo[c], v);
                hi[c] = fmax(hi[c], v);
            }
        }
        for (int32_t j = clamp_index(ceil(lo[0]), g->size[1]); j <= hi[0] && j < g->size[1]; j++)
            for (int32_t k = clamp_index(ceil(lo[1]), g->size[2]); k <= hi[1] && k < g->size[2]; k++) {
                double y = g->low[1] + g->step_mm * (j + line_shift[0]);
                double z = g->low[2] + g->step_mm * (k + line_shift[1]), w[3], sum = 0;
                for (int a = 0; a < 3; a++) {
                    const double *u = p[(a + 1) % 3], *v = p[(a + 2) % 3];
                    w[a] = (u[1] - y) * (v[2] - z) - (u[2] - z) * (v[1] - y);
                    sum += w[a];
                }
                bool out = w[0] > 0 && w[1] > 0 && w[2] > 0, in = w[0] < 0 && w[1] < 0 && w[2] < 0;
                if (!out && !in) continue;
                double x = (w[0] * p[0][0] + w[1] * p[1][0] + w[2] * p[2][0]) / sum;
                double i = ceil((x - g->low[0]) / g->step_mm);
                if (i >= g->size[0]) continue;
                /* the projected turn is counter-clockwise where the normal has +x: the line leaves the body */
                change[cell_index(g, i < 0 ? 0 : (int32_t)i, j, k)] += out ? -1 : 1;
            }
    }
}

static void mark_band(const sdf_grid *g, const surface *s, uint8_t *near)
{
    for (int32_t t = 0; t < s->triangle_count; t++) {
        int32_t from[3], to[3];
        for (int c = 0; c < 3; c++) {
            double lo = HUGE_VAL, hi = -HUGE_VAL;
            for (int k = 0; k < 3; k++) {
                double v = (s->xyz[3 * (size_t)s->tri[3 * (size_t)t + (size_t)k] + (size_t)c] - g->low[c]) / g->step_mm;
                lo = fmin(lo, v);
                hi = fmax(hi, v);
            }
            double reach = g->band_mm / g->step_mm;
            if (hi + reach < 0 || lo - reach > g->size[c] - 1) goto outside;
            from[c] = clamp_index(floor(lo - reach), g->size[c]);
            to[c] = clamp_index(ceil(hi + reach), g->size[c]);
        }
        for (int32_t k = from[2]; k <= to[2]; k++)
            for (int32_t j = from[1]; j <= to[1]; j++)
                memset(near + cell_index(g, from[0], j, k), 1, (size_t)(to[0] - from[0] + 1));
    outside:;
    }
}

typedef struct fill_job {
    sdf_grid *g;
    const nearest *tree;
    const uint8_t *near;
    const int16_t *change;
} fill_job;

static void fill_lines(int64_t begin, int64_t end, void *context)
{
    const fill_job *job = context;
    sdf_grid *g = job->g;
    for (int64_t line = begin; line < end; line++) {
        int32_t j = (int32_t)(line % g->size[1]), k = (int32_t)(line / g->size[1]);
        int winding = 0;
        for (int32_t i = 0; i < g->size[0]; i++) {
            size_t at = cell_index(g, i, j, k);
            winding += job->change[at];
            double d = g->band_mm;
            if (job->near[at]) {
                double p[3] = {g->low[0] + i * g->step_mm, g->low[1] + j * g->step_mm, g->low[2] + k * g->step_mm};
                d = fmin(d, nearest_point(job->tree, p, NULL, NULL));
            }
            g->value[at] = (float)(winding > 0 ? -d : d);
        }
    }
}

bool sdf_grid_make(const surface *s, const double low[3], const double high[3], double step_mm, double band_mm,
                   sdf_grid *out, err *e)
{
    sdf_grid g = {.step_mm = step_mm, .band_mm = band_mm};
    double cells = 1;
    for (int c = 0; c < 3; c++) {
        g.low[c] = low[c];
        g.size[c] = (int32_t)ceil((high[c] - low[c]) / step_mm) + 1;
        cells *= g.size[c];
    }
    if (!(cells > 0) || cells > 1e9)
        return err_set(e, ERR_RESOURCE, "a distance grid of %.3g cells is too large", cells);
    nearest *tree = NULL;
    if (!nearest_create(s, &tree, e)) return false;
    size_t count = (size_t)cells;
    g.value = NEW_ARRAY(float, count);
    uint8_t *near = NEW_ARRAY(uint8_t, count);
    int16_t *change = NEW_ARRAY(int16_t, count);
    mark_crossings(&g, s, change);
    mark_band(&g, s, near);
    fill_job job = {&g, tree, near, change};
    parallel_for((int64_t)g.size[1] * g.size[2], 64, fill_lines, &job);
    free(near);
    free(change);
    nearest_destroy(&tree);
    *out = g;
    return true;
}

void sdf_grid_free(sdf_grid *g)
{
    free(g->value);
    *g = (sdf_grid){0};
}

double sdf_grid_at(const sdf_grid *g, const double p[3])
{
    int32_t i[3];
    double f[3];
    for (int c = 0; c < 3; c++) {
        double v = fmax(0, fmin(g->size[c] - 1, (p[c] - g->low[c]) / g->step_mm));
        i[c] = v >= g->size[c] - 1 ? g->size[c] - 2 : (int32_t)v;
        f[c] = v - i[c];
    }
    size_t at = cell_index(g, i[0], i[1], i[2]), dy = (size_t)g->size[0], dz = dy * (size_t)g->size[1];
    const float *v = g->value + at;
    double x00 = (double)v[0] * (1 - f[0]) + (double)v[1] * f[0];
    double x10 = (double)v[dy] * (1 - f[0]) + (double)v[dy + 1] * f[0];
    double x01 = (double)v[dz] * (1 - f[0]) + (double)v[dz + 1] * f[0];
    double x11 = (double)v[dz + dy] * (1 - f[0]) + (double)v[dz + dy + 1] * f[0];
    return (x00 * (1 - f[1]) + x10 * f[1]) * (1 - f[2]) + (x01 * (1 - f[1]) + x11 * f[1]) * f[2];
}

void sdf_grid_normal(const sdf_grid *g, const double p[3], double n[3])
{
    for (int c = 0; c < 3; c++) {
        double a[3], b[3];
        vec_copy(p, a);
        vec_copy(p, b);
        a[c] += g->step_mm;
        b[c] -= g->step_mm;
        n[c] = sdf_grid_at(g, a) - sdf_grid_at(g, b);
    }
    vec_normalize(n);
}
