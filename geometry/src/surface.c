#include "geometry/surface.h"
#include "geometry/mem.h"
#include "geometry/union_find.h"
#include "geometry/triangle.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

surface surface_new(int32_t vertex_count, int32_t triangle_count)
{
    return (surface){.vertex_count = vertex_count,
                     .triangle_count = triangle_count,
                     .xyz = NEW_ARRAY(double, 3 * (size_t)vertex_count),
                     .tri = NEW_ARRAY(int32_t, 3 * (size_t)triangle_count)};
}

void surface_free(surface *s)
{
    free(s->xyz);
    free(s->tri);
    free(s->rgb);
    *s = (surface){0};
}

surface surface_copy(const surface *s)
{
    surface c = *s;
    c.xyz = COPY_ARRAY(double, s->xyz, 3 * (size_t)s->vertex_count);
    c.tri = COPY_ARRAY(int32_t, s->tri, 3 * (size_t)s->triangle_count);
    if (s->rgb) c.rgb = COPY_ARRAY(uint8_t, s->rgb, 3 * (size_t)s->vertex_count);
    return c;
}

bool surface_check(const surface *s, err *e)
{
    if (s->vertex_count < 3 || s->triangle_count < 1)
        return err_set(e, ERR_GEOMETRY, "the surface is empty (%d vertices, %d triangles)", s->vertex_count,
                       s->triangle_count);
    for (int64_t i = 0; i < 3 * (int64_t)s->vertex_count; i++)
        if (!isfinite(s->xyz[i]))
            return err_set(e, ERR_GEOMETRY, "vertex %lld has a coordinate that is not a finite number",
                           (long long)(i / 3));
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * (size_t)t;
        for (int k = 0; k < 3; k++)
            if (v[k] < 0 || v[k] >= s->vertex_count)
                return err_set(e, ERR_GEOMETRY, "triangle %d names vertex %d of %d", t, v[k], s->vertex_count);
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
            return err_set(e, ERR_GEOMETRY, "triangle %d repeats a vertex", t);
    }
    return true;
}

void surface_bounds(const surface *s, double low[3], double high[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = HUGE_VAL;
        high[c] = -HUGE_VAL;
    }
    for (int32_t v = 0; v < s->vertex_count; v++)
        for (int c = 0; c < 3; c++) {
            low[c] = fmin(low[c], s->xyz[3 * (size_t)v + c]);
            high[c] = fmax(high[c], s->xyz[3 * (size_t)v + c]);
        }
}

double surface_area(const surface *s)
{
    double sum = 0, n[3];
    for (int32_t t = 0; t < s->triangle_count; t++) {
        triangle_area_vector(s, t, n);
        sum += vec_norm(n) / 2;
    }
    return sum;
}

double surface_volume(const surface *s)
{
    if (!s->vertex_count) return 0;
    double sum = 0;
    const double *origin = s->xyz; /* near the surface: less cancellation */
    for (int32_t t = 0; t < s->triangle_count; t++) {
        const int32_t *v = s->tri + 3 * (size_t)t;
        sum += vec_six_volume(origin, s->xyz + 3 * (size_t)v[0], s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[2]);
    }
    return sum / 6;
}

double *surface_vertex_normals(const surface *s)
{
    double *normal = NEW_ARRAY(double, 3 * (size_t)s->vertex_count), n[3];
    for (int32_t t = 0; t < s->triangle_count; t++) {
        triangle_area_vector(s, t, n);
        for (int k = 0; k < 3; k++) {
            double *m = normal + 3 * (size_t)s->tri[3 * (size_t)t + k];
            vec_add(m, n, m);
        }
    }
    for (int32_t v = 0; v < s->vertex_count; v++) vec_normalize(normal + 3 * (size_t)v);
    return normal;
}

void surface_transform(surface *s, const rigid *a)
{
    for (int32_t v = 0; v < s->vertex_count; v++) rigid_apply(a, s->xyz + 3 * (size_t)v, s->xyz + 3 * (size_t)v);
}

void surface_flip(surface *s)
{
    for (int32_t t = 0; t < s->triangle_count; t++) {
        int32_t *v = s->tri + 3 * (size_t)t, keep = v[1];
        v[1] = v[2];
        v[2] = keep;
    }
}

static int compare_edges(const void *a, const void *b)
{
    const int32_t *x = a, *y = b;
    if (x[0] != y[0]) return x[0] < y[0] ? -1 : 1;
    return (x[1] > y[1]) - (x[1] < y[1]);
}

/* Every edge of every triangle, lower vertex first, sorted; [2*3*triangle_count], the caller frees. */
static int32_t *sorted_edges(const surface *s)
{
    size_t count = 3 * (size_t)s->triangle_count;
    int32_t *edge = NEW_ARRAY(int32_t, 2 * count);
    for (size_t i = 0; i < count; i++) {
        int32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        edge[2 * i] = a < b ? a : b;
        edge[2 * i + 1] = a < b ? b : a;
    }
    qsort(edge, count, 2 * sizeof *edge, compare_edges);
    return edge;
}

void surface_edge_census(const surface *s, int32_t *boundary_edges, int32_t *nonmanifold_edges)
{
    size_t count = 3 * (size_t)s->triangle_count;
    int32_t *edge = sorted_edges(s);
    *boundary_edges = *nonmanifold_edges = 0;
    for (size_t i = 0, j; i < count; i = j) {
        for (j = i + 1; j < count && !compare_edges(edge + 2 * i, edge + 2 * j); j++) {}
        if (j - i == 1) ++*boundary_edges;
        if (j - i > 2) ++*nonmanifold_edges;
    }
    free(edge);
}

int32_t surface_hole_count(const surface *s)
{
    size_t count = 3 * (size_t)s->triangle_count;
    int32_t *edge = sorted_edges(s), *parent = NEW_ARRAY(int32_t, s->vertex_count), holes = 0;
    uint8_t *touched = NEW_ARRAY(uint8_t, s->vertex_count);
    for (int32_t v = 0; v < s->vertex_count; v++) parent[v] = v;
    for (size_t i = 0, j; i < count; i = j) {
        for (j = i + 1; j < count && !compare_edges(edge + 2 * i, edge + 2 * j); j++) {}
        if (j - i != 1) continue;
        int32_t a = union_root(parent, edge[2 * i]), b = union_root(parent, edge[2 * i + 1]);
        int joined = (touched[edge[2 * i]] != 0) + (touched[edge[2 * i + 1]] != 0);
        if (a != b) parent[a] = b;
        holes += joined == 0 ? 1 : joined == 2 && a != b ? -1 : 0;
        touched[edge[2 * i]] = touched[edge[2 * i + 1]] = 1;
    }
    free(edge);
    free(parent);
    free(touched);
    return holes;
}

int32_t surface_components(const surface *s, int32_t **component)
{
    int32_t *parent = NEW_ARRAY(int32_t, s->vertex_count), *number = NEW_ARRAY(int32_t, s->vertex_count);
    for (int32_t v = 0; v < s->vertex_count; v++) {
        parent[v] = v;
        number[v] = -1;
    }
    for (int32_t t = 0; t < s->triangle_count; t++)
        for (int k = 1; k < 3; k++) {
            int32_t a = union_root(parent, s->tri[3 * (size_t)t]), b = union_root(parent, s->tri[3 * (size_t)t + k]);
            if (a < b)
                parent[b] = a;
            else
                parent[a] = b;
        }
    int32_t count = 0;
    *component = NEW_ARRAY(int32_t, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) {
        int32_t root = union_root(parent, s->tri[3 * (size_t)t]);
        if (number[root] < 0) number[root] = count++;
        (*component)[t] = number[root];
    }
    free(parent);
    free(number);
    return count;
}

surface surface_select(const surface *s, const uint8_t *keep)
{
    int32_t *number = NEW_ARRAY(int32_t, s->vertex_count), vertices = 0, triangles = 0;
    for (int32_t t = 0; t < s->triangle_count; t++) {
        if (!keep[t]) continue;
        triangles++;
        for (int k = 0; k < 3; k++) number[s->tri[3 * (size_t)t + k]] = 1;
    }
    for (int32_t v = 0; v < s->vertex_count; v++) number[v] = number[v] ? vertices++ : -1;
    surface out = surface_new(vertices, triangles);
    if (s->rgb) out.rgb = NEW_ARRAY(uint8_t, 3 * (size_t)vertices);
    for (int32_t v = 0; v < s->vertex_count; v++) {
        if (number[v] < 0) continue;
        vec_copy(s->xyz + 3 * (size_t)v, out.xyz + 3 * (size_t)number[v]);
        if (s->rgb) memcpy(out.rgb + 3 * (size_t)number[v], s->rgb + 3 * (size_t)v, 3);
    }
    triangles = 0;
    for (int32_t t = 0; t < s->triangle_count; t++) {
        if (!keep[t]) continue;
        for (int k = 0; k < 3; k++) out.tri[3 * (size_t)triangles + k] = number[s->tri[3 * (size_t)t + k]];
        triangles++;
    }
    free(number);
    return out;
}

surface surface_joined(const surface *a, const surface *b)
{
    surface out = surface_new(a->vertex_count + b->vertex_count, a->triangle_count + b->triangle_count);
    const surface *part[2] = {a, b};
    size_t first = 0, triangle = 0;
    for (int k = 0; k < 2; k++) {
        size_t vertices = (size_t)part[k]->vertex_count, triangles = (size_t)part[k]->triangle_count;
        if (vertices) memcpy(out.xyz + 3 * first, part[k]->xyz, 3 * vertices * sizeof *out.xyz);
        for (size_t i = 0; i < 3 * triangles; i++) out.tri[3 * triangle + i] = part[k]->tri[i] + (int32_t)first;
        first += vertices;
        triangle += triangles;
    }
    return out;
}
