#include "app/planner/identity/point_seek.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

enum { GRID_MOST = 12 };
static const double grid_mm = 0.7, least_facing = 0.2;

static void corners(const surface *s, int32_t t, const double *p[3])
{
    for (int k = 0; k < 3; k++) p[k] = s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + k];
}

surface point_crop(const surface *s, const double x[3], double reach_mm)
{
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const double *p[3];
        corners(s, t, p);
        for (int k = 0; k < 3; k++)
            if (fabs(p[k][0] - x[0]) < reach_mm && vec_distance(p[k], x) < reach_mm) keep[t] = 1;
    }
    surface out = surface_select(s, keep);
    free(keep);
    return out;
}

/* Triangles that face the direction, or look away from it. */
static surface facing(const surface *s, const point_seek *k)
{
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const double *p[3];
        double u[3], w[3], n[3];
        corners(s, t, p);
        vec_sub(p[1], p[0], u);
        vec_sub(p[2], p[0], w);
        vec_cross(u, w, n);
        vec_normalize(n);
        keep[t] = !k->facing || k->facing * vec_dot(n, k->direction) > least_facing;
    }
    surface out = surface_select(s, keep);
    free(keep);
    return out;
}

static double worth(const point_seek *s, const double x[3])
{
    double d[3], sum = 0;
    vec_sub(x, s->from, d);
    for (int c = 0; c < 3; c++) sum += s->direction[c] * d[c] - s->pull[c] * d[c] * d[c] / 2;
    return sum;
}

/* Of the triangle's grid points the one of most worth within reach (*most: -HUGE_VAL if none is), and the nearest. */
static void ask_triangle(const double *const p[3], const point_seek *s, double *most, double at[3], double *nearest)
{
    double longest = 0;
    for (int k = 0; k < 3; k++) longest = fmax(longest, vec_distance(p[k], p[(k + 1) % 3]));
    int n = (int)fmin(fmax(ceil(longest / grid_mm), 1), GRID_MOST);
    *most = -HUGE_VAL;
    *nearest = HUGE_VAL;
    for (int i = 0; i <= n; i++)
        for (int k = 0; k <= n - i; k++) {
            double x[3];
            for (int c = 0; c < 3; c++) x[c] = (i * p[0][c] + k * p[1][c] + (n - i - k) * p[2][c]) / n;
            double d = vec_distance(x, s->from), w = worth(s, x);
            *nearest = fmin(*nearest, d);
            if (d > s->reach_mm || w <= *most) continue;
            *most = w;
            vec_copy(x, at);
        }
}

bool point_seek_on(const surface *near_by, const point_seek *s, double out[3])
{
    surface patch = facing(near_by, s);
    int32_t *piece, pieces = patch.triangle_count ? surface_components(&patch, &piece) : 0;
    double *most = NEW_ARRAY(double, pieces), *at = NEW_ARRAY(double, 3 * pieces), least = HUGE_VAL;
    int32_t best = -1;
    for (int32_t i = 0; i < pieces; i++) most[i] = -HUGE_VAL;
    for (int32_t t = 0; t < patch.triangle_count; t++) {
        const double *p[3];
        double value, place[3] = {0}, nearest;
        corners(&patch, t, p);
        ask_triangle(p, s, &value, place, &nearest);
        if (nearest < least) {
            least = nearest;
            best = piece[t];
        }
        if (value <= most[piece[t]]) continue;
        most[piece[t]] = value;
        vec_copy(place, at + 3 * (size_t)piece[t]);
    }
    bool found = best >= 0 && most[best] > -HUGE_VAL;
    if (found) vec_copy(at + 3 * (size_t)best, out);
    if (pieces) free(piece);
    free(most);
    free(at);
    surface_free(&patch);
    return found;
}

bool point_seek_saddle(const surface *near_by, const point_seek *s, int axis, double out[3])
{
    enum { STEPS = 6 };
    const double along_pull = 0.02;
    double least = HUGE_VAL;
    for (int step = -STEPS; step <= STEPS; step++) {
        point_seek one = *s;
        double x[3], d[3];
        one.from[axis] += step;
        if (!point_seek_on(near_by, &one, x)) continue;
        vec_sub(x, s->from, d);
        double far = vec_dot(d, s->direction) + along_pull * step * step / 2;
        if (far >= least) continue;
        least = far;
        vec_copy(x, out);
    }
    return least < HUGE_VAL;
}
