#include "warp.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "dense.h"
#include <assert.h>
#include <stdlib.h>

/* Width of a multiquadric: about the distance between landmarks of the face, so that none leaves a dimple. */
static const double width_mm = 14;

static double basis(const double a[3], const double b[3])
{
    double d[3];
    vec_sub(a, b, d);
    return sqrt(vec_dot(d, d) + width_mm * width_mm);
}

void warp_add(warp_pairs *p, const double from[3], const double to[3])
{
    if (p->count == p->room) {
        p->room = 2 * p->room + 32;
        p->from = GROW_ARRAY(double, p->from, 3 * p->room);
        p->to = GROW_ARRAY(double, p->to, 3 * p->room);
    }
    vec_copy(from, p->from + 3 * p->count);
    vec_copy(to, p->to + 3 * p->count++);
}

void warp_pairs_free(warp_pairs *p)
{
    free(p->from);
    free(p->to);
    *p = (warp_pairs){0};
}

warp warp_through(const warp_pairs *p)
{
    assert(p->count >= 4);
    warp w = {.count = p->count, .from = COPY_ARRAY(double, p->from, 3 * p->count)};
    int n = p->count + 4;
    double *m = NEW_ARRAY(double, n *n);
    w.weight = NEW_ARRAY(double, 3 * n);
    for (int i = 0; i < p->count; i++) {
        const double *a = p->from + 3 * i;
        for (int j = 0; j < p->count; j++) m[n * i + j] = basis(a, p->from + 3 * j);
        for (int k = 0; k < 4; k++) m[n * i + p->count + k] = m[n * (p->count + k) + i] = k == 0 ? 1 : a[k - 1];
        vec_sub(p->to + 3 * i, a, w.weight + 3 * i);
    }
    dense_solve(m, w.weight, n, 3);
    free(m);
    return w;
}

void warp_free(warp *w)
{
    free(w->from);
    free(w->weight);
    *w = (warp){0};
}

void warp_apply(const warp *w, const double x[3], double out[3])
{
    const double *tail = w->weight + 3 * w->count;
    double y[3];
    vec_add(x, tail, y);
    for (int k = 0; k < 3; k++) vec_axpy(y, x[k], tail + 3 * (k + 1), y);
    for (int i = 0; i < w->count; i++) vec_axpy(y, basis(x, w->from + 3 * i), w->weight + 3 * i, y);
    vec_copy(y, out);
}

struct surface_job {
    const warp *w;
    double *xyz;
};

static void warp_range(int64_t begin, int64_t end, void *context)
{
    const struct surface_job *j = context;
    for (int64_t i = begin; i < end; i++) warp_apply(j->w, j->xyz + 3 * i, j->xyz + 3 * i);
}

void warp_surface(const warp *w, surface *s)
{
    struct surface_job j = {w, s->xyz};
    parallel_for(s->vertex_count, 512, warp_range, &j);
}
