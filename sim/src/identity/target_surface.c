#include "sim/target_surface.h"
#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/triangle.h"
#include "geometry/vec.h"
#include "sim/src/identity/target_cuts.h"
#include <stdlib.h>
#include <string.h>

/* Triangles are sorted by where they look: into the nearest of the 26 directions to the neighbours of a cube, at most
 * cone_deg away, so that a thin plate's far side does not hide the near one. */
enum { DIRECTIONS = 26, CUT = 8 };
static const double cone_deg = 28;

struct target_surface {
    distance_tree *tree[DIRECTIONS]; /* NULL: none looks there */
    int32_t *triangle[DIRECTIONS];   /* of the surface, for each of the tree's */
    surface s;
    double *normal;  /* [3*vertices] */
    uint8_t *border; /* [vertices] 1: on an edge that only one triangle has, or a cut */
    uint8_t *open;   /* [triangles] bit k: the edge opposite corner k is such a one; CUT: the whole is a cut */
};

static void unit_normal(const surface *s, size_t triangle, double n[3], double *mm2)
{
    triangle_area_vector(s, (int32_t)triangle, n);
    *mm2 = vec_normalize(n) / 2;
}

/* Edges that only one triangle has, or only one that is no cut. */
static void mark_border(target_surface *t)
{
    size_t count = 3 * (size_t)t->s.triangle_count;
    half_edge *edge = half_edges_sorted(&t->s);
    uint8_t *cut = target_cuts(&t->s, edge);
    for (size_t i = 0; i < count / 3; i++) t->open[i] = cut[i] ? CUT : 0;
    free(cut);
    for (size_t i = 0, end; i < count; i = end) {
        size_t whole = 0;
        for (end = i; end < count && half_edge_same(&edge[i], &edge[end]); end++)
            whole += t->open[edge[end].triangle] < CUT;
        if (whole != 1) continue;
        t->border[edge[i].low] = t->border[edge[i].high] = 1;
        for (size_t k = i; k < end; k++) t->open[edge[k].triangle] |= (uint8_t)(1 << edge[k].corner);
    }
    free(edge);
}

static void direction(int k, double out[3])
{
    k += k >= DIRECTIONS / 2; /* leaving out the middle */
    out[0] = k % 3 - 1;
    out[1] = k / 3 % 3 - 1;
    out[2] = k / 9 - 1;
    vec_normalize(out);
}

static int looks(const surface *s, size_t triangle)
{
    double n[3], d[3], mm2, most = -HUGE_VAL;
    int best = 0;
    unit_normal(s, triangle, n, &mm2);
    for (int k = 0; k < DIRECTIONS; k++) {
        direction(k, d);
        if (vec_dot(n, d) <= most) continue;
        most = vec_dot(n, d);
        best = k;
    }
    return best;
}

static void sort_by_direction(target_surface *t)
{
    size_t count = (size_t)t->s.triangle_count;
    uint8_t *where = NEW_ARRAY(uint8_t, count);
    for (size_t i = 0; i < count; i++) where[i] = (uint8_t)looks(&t->s, i);
    for (int k = 0; k < DIRECTIONS; k++) {
        surface part = t->s; /* its vertices, some of its triangles */
        part.tri = NEW_ARRAY(int32_t, 3 * count);
        part.triangle_count = 0;
        t->triangle[k] = NEW_ARRAY(int32_t, count);
        for (size_t i = 0; i < count; i++) {
            if (where[i] != k) continue;
            memcpy(part.tri + 3 * (size_t)part.triangle_count, t->s.tri + 3 * i, 3 * sizeof *part.tri);
            t->triangle[k][part.triangle_count++] = (int32_t)i;
        }
        if (part.triangle_count) t->tree[k] = distance_tree_make(&part);
        free(part.tri);
    }
    free(where);
}

target_surface *target_surface_make(const surface *s)
{
    target_surface *t = NEW_ARRAY(target_surface, 1);
    *t = (target_surface){.s = surface_copy(s),
                          .normal = surface_vertex_normals(s),
                          .border = NEW_ARRAY(uint8_t, s->vertex_count),
                          .open = NEW_ARRAY(uint8_t, s->triangle_count)};
    mark_border(t);
    sort_by_direction(t);
    return t;
}

void target_surface_free(target_surface **t)
{
    if (!*t) return;
    for (int k = 0; k < DIRECTIONS; k++) {
        distance_tree_free(&(*t)->tree[k]);
        free((*t)->triangle[k]);
    }
    surface_free(&(*t)->s);
    free((*t)->normal);
    free((*t)->border);
    free((*t)->open);
    free(*t);
    *t = NULL;
}

/* Of a point of the triangle. */
static void corner_weights(const surface *s, const int32_t *v, const double p[3], double w[3])
{
    double e1[3], e2[3], d[3], n[3], c[3];
    const double *a = s->xyz + 3 * (size_t)v[0];
    vec_sub(s->xyz + 3 * (size_t)v[1], a, e1);
    vec_sub(s->xyz + 3 * (size_t)v[2], a, e2);
    vec_sub(p, a, d);
    vec_cross(e1, e2, n);
    double nn = vec_dot(n, n);
    vec_cross(d, e2, c);
    w[1] = nn > 0 ? vec_dot(c, n) / nn : 0;
    vec_cross(e1, d, c);
    w[2] = nn > 0 ? vec_dot(c, n) / nn : 0;
    w[0] = 1 - w[1] - w[2];
}

/* Is the point with these weights on the open border? */
static bool is_open(const target_surface *t, int32_t triangle, const int32_t *v, const double w[3])
{
    static const double on = 1e-6;
    if (t->open[triangle] >= CUT) return true;
    for (int k = 0; k < 3; k++)
        if ((w[k] < on && t->open[triangle] >> k & 1) || (w[k] > 1 - on && t->border[v[k]])) return true;
    return false;
}

/* Of a place of the surface. */
static void fill(const target_surface *t, const distance_hit *hit, target_point *out, double w[3])
{
    const int32_t *v = t->s.tri + 3 * (size_t)hit->triangle;
    corner_weights(&t->s, v, hit->at, w);
    vec_scale(t->normal + 3 * (size_t)v[0], w[0], out->normal);
    for (int k = 1; k < 3; k++) vec_axpy(out->normal, w[k], t->normal + 3 * (size_t)v[k], out->normal);
    vec_normalize(out->normal);
    vec_copy(hit->at, out->at);
    out->triangle = hit->triangle;
}

double target_surface_ask(const target_surface *t, const double p[3], const double n[3], const target_rules *rules,
                          target_point *out)
{
    const double pi = acos(-1.0);
    double best = rules->reach_mm, w[3],
           least = cos(fmin(pi, acos(fmax(-1, fmin(1, rules->facing_cos))) + cone_deg * pi / 180));
    bool found = false, open = false;
    for (int k = 0; k < DIRECTIONS; k++) {
        double d[3];
        distance_hit hit;
        target_point here;
        direction(k, d);
        if (!t->tree[k] || (n && vec_dot(n, d) < least)) continue;
        double far = distance_tree_between(t->tree[k], p, 0, best, &hit);
        if (!(far < best)) continue;
        hit.triangle = t->triangle[k][hit.triangle];
        fill(t, &hit, &here, w);
        if (n && vec_dot(n, here.normal) < rules->facing_cos) continue;
        best = far;
        *out = here;
        found = true;
        open = is_open(t, hit.triangle, t->s.tri + 3 * (size_t)hit.triangle, w);
    }
    return found && !open ? best : HUGE_VAL;
}
