#include "sim/src/identity/target_cuts.h"
#include "geometry/mem.h"
#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

static const double seed_mm2 = 100, cut_mm2 = 400;
static const double even_cos = 1 - 1e-5; /* a quarter of a degree from triangle to triangle of a seed */
static const double off_mm = 0.1, tilt_cos = 0.95;
static const double rim_mm = 1.5; /* a scan's edge is rounded so far: a voxel or two */

static int by_ends(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

bool half_edge_same(const half_edge *a, const half_edge *b) { return a->low == b->low && a->high == b->high; }

half_edge *half_edges_sorted(const surface *s)
{
    size_t count = 3 * (size_t)s->triangle_count;
    half_edge *edge = NEW_ARRAY(half_edge, count);
    for (size_t i = 0; i < count; i++) {
        size_t first = i / 3 * 3;
        int32_t a = s->tri[first + (i + 1) % 3], b = s->tri[first + (i + 2) % 3];
        edge[i] = (half_edge){a < b ? a : b, a < b ? b : a, (int32_t)(i / 3), (int32_t)(i % 3)};
    }
    qsort(edge, count, sizeof *edge, by_ends);
    return edge;
}

typedef struct cuts {
    const surface *s;
    const half_edge *edge;
    double *normal, *mm2; /* of triangles: [3*count] unit, [count] */
    int32_t *parent;      /* of groups of triangles, or -1: of none */
    uint8_t *cut;
} cuts;

static void join(cuts *c, int32_t a, int32_t b)
{
    a = union_root(c->parent, a);
    b = union_root(c->parent, b);
    c->parent[a > b ? a : b] = a < b ? a : b;
}

/* Neighbours that belong to groups become one, where they are even enough. */
static void join_neighbours(cuts *c, double cos)
{
    for (size_t i = 0; i + 1 < 3 * (size_t)c->s->triangle_count; i++) {
        int32_t a = c->edge[i].triangle, b = c->edge[i + 1].triangle;
        if (!half_edge_same(&c->edge[i], &c->edge[i + 1]) || c->parent[a] < 0 || c->parent[b] < 0) continue;
        if (vec_dot(c->normal + 3 * (size_t)a, c->normal + 3 * (size_t)b) > cos) join(c, a, b);
    }
}

/* [triangles] area of each group, at its root; the caller frees. */
static double *group_areas(cuts *c)
{
    double *mm2 = NEW_ARRAY(double, c->s->triangle_count);
    for (int32_t i = 0; i < c->s->triangle_count; i++)
        if (c->parent[i] >= 0) mm2[union_root(c->parent, i)] += c->mm2[i];
    return mm2;
}

/* The plane that the triangles of a group lie in, in the mean. */
static void group_plane(const cuts *c, const int32_t *group, int32_t which, double at[3], double normal[3])
{
    double mm2 = 0;
    vec_scale(normal, 0, normal);
    vec_scale(at, 0, at);
    for (int32_t i = 0; i < c->s->triangle_count; i++) {
        if (group[i] != which) continue;
        vec_axpy(normal, c->mm2[i], c->normal + 3 * (size_t)i, normal);
        for (int k = 0; k < 3; k++)
            vec_axpy(at, c->mm2[i] / 3, c->s->xyz + 3 * (size_t)c->s->tri[3 * (size_t)i + (size_t)k], at);
        mm2 += c->mm2[i];
    }
    vec_scale(at, 1 / mm2, at);
    vec_normalize(normal);
}

/* Groups of neighbours all of whose corners lie so far from the plane at most, and look so. */
static void group_near(cuts *c, const double at[3], const double normal[3], double mm, double cos)
{
    for (int32_t i = 0; i < c->s->triangle_count; i++) {
        bool on = vec_dot(c->normal + 3 * (size_t)i, normal) > cos;
        for (int k = 0; on && k < 3; k++) {
            double d[3];
            vec_sub(c->s->xyz + 3 * (size_t)c->s->tri[3 * (size_t)i + (size_t)k], at, d);
            on = fabs(vec_dot(d, normal)) < mm;
        }
        c->parent[i] = on ? i : -1;
    }
    join_neighbours(c, -2);
}

/* Marks all of the plane piece that the group is part of, and the edge around it. */
static void grow(cuts *c, const int32_t *group, int32_t which)
{
    double at[3] = {0}, normal[3] = {0};
    size_t n = (size_t)c->s->triangle_count;
    uint8_t *hit = NEW_ARRAY(uint8_t, n);
    group_plane(c, group, which, at, normal);
    group_near(c, at, normal, off_mm, tilt_cos);
    double *mm2 = group_areas(c);
    for (size_t i = 0; i < n; i++)
        if (c->parent[i] >= 0 && mm2[union_root(c->parent, (int32_t)i)] >= cut_mm2) c->cut[i] = 1;
    group_near(c, at, normal, rim_mm, -2);
    for (size_t i = 0; i < n; i++)
        if (c->parent[i] >= 0 && c->cut[i]) hit[union_root(c->parent, (int32_t)i)] = 1;
    for (size_t i = 0; i < n; i++)
        if (c->parent[i] >= 0 && hit[union_root(c->parent, (int32_t)i)]) c->cut[i] = 1;
    free(hit);
    free(mm2);
}

uint8_t *target_cuts(const surface *s, const half_edge *edge)
{
    int32_t n = s->triangle_count;
    cuts c = {
        s, edge, NEW_ARRAY(double, 3 * (size_t)n), NEW_ARRAY(double, n), NEW_ARRAY(int32_t, n), NEW_ARRAY(uint8_t, n)};
    int32_t *group = NEW_ARRAY(int32_t, n);
    for (int32_t i = 0; i < n; i++) {
        triangle_area_vector(s, i, c.normal + 3 * (size_t)i);
        c.mm2[i] = vec_normalize(c.normal + 3 * (size_t)i) / 2;
        c.parent[i] = i;
    }
    join_neighbours(&c, even_cos);
    double *mm2 = group_areas(&c);
    for (int32_t i = 0; i < n; i++) group[i] = union_root(c.parent, i);
    for (int32_t i = 0; i < n; i++)
        if (mm2[i] >= seed_mm2 && !c.cut[i]) grow(&c, group, i);
    free(c.normal);
    free(c.mm2);
    free(c.parent);
    free(group);
    free(mm2);
    return c.cut;
}
