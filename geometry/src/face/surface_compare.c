#include "geometry/surface_compare.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/parallel.h"
#include "geometry/src/open_border.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

typedef struct distance_job {
    const surface *from;
    const double *normal;
    const nearest *to;
    const uint8_t *border;
    double *out;
} distance_job;

static void measure(int64_t begin, int64_t end, void *context)
{
    const distance_job *j = context;
    for (int64_t v = begin; v < end; v++) {
        const double *p = j->from->xyz + 3 * v, *n = j->normal + 3 * v;
        double q[3], d[3];
        int32_t triangle;
        j->out[v] = (double)NAN;
        if (!(vec_norm(n) > 0)) continue;
        double mm = nearest_point(j->to, p, q, &triangle);
        if (j->border[triangle]) continue;
        vec_sub(q, p, d);
        j->out[v] = vec_dot(d, n) >= 0 ? mm : -mm;
    }
}

bool surface_signed_distance(const surface *from, const surface *to, double *out, err *e)
{
    nearest *tree = NULL;
    if (!surface_check(from, e) || !surface_check(to, e) || !nearest_create(to, &tree, e)) return false;
    double *normal = surface_vertex_normals(from);
    uint8_t *border = open_border_triangles(to);
    distance_job job = {from, normal, tree, border, out};
    parallel_for(from->vertex_count, 256, measure, &job);
    free(normal);
    free(border);
    nearest_destroy(&tree);
    return true;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

distance_stats distance_summary(const double *signed_mm, const uint8_t *selected, uint8_t value, int32_t count)
{
    distance_stats s = {0};
    double *size = NEW_ARRAY(double, count), square = 0;
    for (int32_t v = 0; v < count; v++) {
        if (selected[v] != value) continue;
        if (!isfinite(signed_mm[v])) {
            s.left_out++;
            continue;
        }
        double d = fabs(signed_mm[v]);
        size[s.count++] = d;
        s.mean += signed_mm[v];
        s.mean_abs += d;
        square += d * d;
        s.under_1 += d < 1;
        s.under_2 += d < 2;
    }
    double n = s.count ? s.count : (double)NAN;
    qsort(size, (size_t)s.count, sizeof *size, by_size);
    s.mean /= n;
    s.mean_abs /= n;
    s.rms = sqrt(square / n);
    s.under_1 /= n;
    s.under_2 /= n;
    s.p90 = s.count ? size[(9 * (int64_t)s.count + 9) / 10 - 1] : (double)NAN;
    s.p95 = s.count ? size[(19 * (int64_t)s.count + 19) / 20 - 1] : (double)NAN;
    free(size);
    return s;
}
