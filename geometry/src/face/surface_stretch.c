#include "geometry/surface_stretch.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>

/* Squared lengths and the product of the two edges from the first corner. */
static void metric(const surface *s, const int32_t v[3], double *aa, double *ab, double *bb)
{
    double a[3], b[3];
    vec_sub(s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[0], a);
    vec_sub(s->xyz + 3 * (size_t)v[2], s->xyz + 3 * (size_t)v[0], b);
    *aa = vec_dot(a, a);
    *ab = vec_dot(a, b);
    *bb = vec_dot(b, b);
}

void surface_stretch(const surface *rest, const surface *moved, double *out)
{
    assert(rest->vertex_count == moved->vertex_count && rest->triangle_count == moved->triangle_count);
    double *area = NEW_ARRAY(double, rest->vertex_count);
    for (int32_t v = 0; v < rest->vertex_count; v++) out[v] = 0;
    for (size_t t = 0; t < (size_t)rest->triangle_count; t++) {
        const int32_t *v = rest->tri + 3 * t;
        double A, B, C, a, b, c;
        metric(rest, v, &A, &B, &C);
        metric(moved, v, &a, &b, &c);
        double det = A * C - B * B;
        if (!(det > 1e-12 * A * C)) continue;
        /* eigenvalues of (rest metric)^-1 (moved metric): squares of the principal stretches */
        double trace = (C * a - 2 * B * b + A * c) / det, product = (a * c - b * b) / det;
        double larger = trace / 2 + sqrt(fmax(0, trace * trace / 4 - product)), weight = sqrt(det) / 2;
        for (int k = 0; k < 3; k++) {
            out[v[k]] += weight * sqrt(larger);
            area[v[k]] += weight;
        }
    }
    for (int32_t v = 0; v < rest->vertex_count; v++) out[v] = area[v] > 0 ? 100 * (out[v] / area[v] - 1) : (double)NAN;
    free(area);
}
