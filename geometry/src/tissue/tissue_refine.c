#include "geometry/tissue_refine.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const int edge_ends[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

typedef struct edge_list {
    int32_t count;
    uint64_t *key;  /* low end << 32 | high end, ascending */
    uint8_t *outer; /* on the surface */
} edge_list;

static uint64_t key_of(int32_t a, int32_t b)
{
    return a < b ? (uint64_t)a << 32 | (uint32_t)b : (uint64_t)b << 32 | (uint32_t)a;
}

static int by_key(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* -1: no such edge. */
static int32_t edge_at(const edge_list *l, int32_t a, int32_t b)
{
    uint64_t key = key_of(a, b), *found = bsearch(&key, l->key, (size_t)l->count, sizeof key, by_key);
    return found ? (int32_t)(found - l->key) : -1;
}

static edge_list list_edges(const tetmesh *m)
{
    size_t n = 0, all = 6 * (size_t)m->tet_count;
    uint64_t *key = NEW_ARRAY(uint64_t, all);
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int k = 0; k < 6; k++, n++)
            key[n] = key_of(m->tet[4 * (size_t)t + edge_ends[k][0]], m->tet[4 * (size_t)t + edge_ends[k][1]]);
    qsort(key, all, sizeof *key, by_key);
    n = 0;
    for (size_t i = 0; i < all; i++)
        if (n == 0 || key[n - 1] != key[i]) key[n++] = key[i];
    edge_list l = {(int32_t)n, key, NEW_ARRAY(uint8_t, n)};
    int32_t *face, faces = tetmesh_boundary(m, &face, NULL);
    for (int32_t f = 0; f < faces; f++)
        for (int k = 0; k < 3; k++) l.outer[edge_at(&l, face[3 * f + k], face[3 * f + (k + 1) % 3])] = 1;
    free(face);
    return l;
}

/* Eight tets of the ten nodes: corners 0-3, and 4 + k in the middle of edge k. */
static void split_tet(const double *xyz, const int32_t node[10], int32_t out[32])
{
    static const int corner[4][4] = {{0, 4, 5, 6}, {1, 4, 7, 8}, {2, 5, 7, 9}, {3, 6, 8, 9}};
    static const int diagonal[3][2] = {{4, 9}, {5, 8}, {6, 7}};
    static const int around[3][4] = {{5, 6, 8, 7}, {4, 6, 9, 7}, {4, 5, 9, 8}}; /* the other four, in a ring */
    int best = 0;
    double shortest = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double d = vec_distance(xyz + 3 * (size_t)node[diagonal[k][0]], xyz + 3 * (size_t)node[diagonal[k][1]]);
        if (d < shortest * (1 - 1e-12)) {
            shortest = d;
            best = k;
        }
    }
    for (int k = 0; k < 4; k++)
        for (int a = 0; a < 4; a++) {
            const int inner[4] = {diagonal[best][0], diagonal[best][1], around[best][k], around[best][(k + 1) % 4]};
            out[4 * k + a] = node[corner[k][a]];
            out[16 + 4 * k + a] = node[inner[a]];
        }
    for (int k = 0; k < 8; k++) {
        int32_t *v = out + 4 * k, keep = v[2];
        if (vec_six_volume(xyz + 3 * (size_t)v[0], xyz + 3 * (size_t)v[1], xyz + 3 * (size_t)v[2],
                           xyz + 3 * (size_t)v[3]) > 0)
            continue;
        v[2] = v[3];
        v[3] = keep;
    }
}

static void hang(const attach_map *a, int32_t u, int32_t v, attach_map *out, int32_t fresh)
{
    out->segment[fresh] = -1;
    if (a->kind[u] == NODE_FREE || a->kind[v] == NODE_FREE || a->segment[u] != a->segment[v]) return;
    out->segment[fresh] = a->segment[u];
    out->kind[fresh] = NODE_TIED;
    if (a->kind[u] == NODE_TIED && a->kind[v] == NODE_TIED) return;
    double *n = out->normal + 3 * (size_t)fresh;
    out->kind[fresh] = NODE_SLIDING;
    if (a->kind[u] == NODE_SLIDING) vec_add(n, a->normal + 3 * (size_t)u, n);
    if (a->kind[v] == NODE_SLIDING) vec_add(n, a->normal + 3 * (size_t)v, n);
    if (vec_normalize(n) > 0) return;
    out->kind[fresh] = NODE_FREE; /* normals that cancel: a thin plate's two sides */
    out->segment[fresh] = -1;
}

static void pair_up(const attach_map *a, const edge_list *l, int32_t old_nodes, attach_map *out)
{
    int32_t *partner = NEW_ARRAY(int32_t, old_nodes), *pair_of = NEW_ARRAY(int32_t, old_nodes);
    uint8_t *upper = NEW_ARRAY(uint8_t, old_nodes);
    for (int32_t v = 0; v < old_nodes; v++) partner[v] = v;
    for (int32_t i = 0; i < a->pair_count; i++) {
        int32_t u = a->pair[2 * i], w = a->pair[2 * i + 1];
        partner[u] = w;
        partner[w] = u;
        pair_of[u] = pair_of[w] = i;
        upper[u] = 1;
    }
    for (int32_t e = 0; e < l->count; e++) {
        int32_t u = (int32_t)(l->key[e] >> 32), v = (int32_t)(l->key[e] & 0xffffffff);
        if (!(upper[u] || upper[v]) || (partner[u] != u && !upper[u]) || (partner[v] != v && !upper[v])) continue;
        int32_t other = edge_at(l, partner[u], partner[v]);
        int32_t high = old_nodes + e, low = old_nodes + other;
        if (other < 0 || other == e || out->kind[high] != NODE_FREE || out->kind[low] != NODE_FREE) continue;
        double *n = out->pair_normal + 3 * (size_t)out->pair_count;
        if (partner[u] != u) vec_add(n, a->pair_normal + 3 * (size_t)pair_of[u], n);
        if (partner[v] != v) vec_add(n, a->pair_normal + 3 * (size_t)pair_of[v], n);
        if (!(vec_normalize(n) > 0)) continue;
        out->pair[2 * (size_t)out->pair_count] = high;
        out->pair[2 * (size_t)out->pair_count++ + 1] = low;
    }
    free(partner);
    free(pair_of);
    free(upper);
}

void tissue_refine(const tissue *t, tissue *out)
{
    const tetmesh *m = &t->mesh;
    int32_t old_nodes = m->vertex_count;
    edge_list l = list_edges(m);
    tissue fine = {.mesh = tetmesh_new(old_nodes + l.count, 8 * m->tet_count),
                   .attach = attach_map_new(old_nodes + l.count, t->attach.pair_count + l.count),
                   .side = NEW_ARRAY(uint8_t, old_nodes + l.count),
                   .lips = t->lips};
    memcpy(fine.mesh.xyz, m->xyz, 3 * (size_t)old_nodes * sizeof *m->xyz);
    memcpy(fine.side, t->side, (size_t)old_nodes);
    memcpy(fine.attach.kind, t->attach.kind, (size_t)old_nodes);
    memcpy(fine.attach.segment, t->attach.segment, (size_t)old_nodes * sizeof(int32_t));
    memcpy(fine.attach.normal, t->attach.normal, 3 * (size_t)old_nodes * sizeof(double));
    memcpy(fine.attach.pair, t->attach.pair, 2 * (size_t)t->attach.pair_count * sizeof(int32_t));
    memcpy(fine.attach.pair_normal, t->attach.pair_normal, 3 * (size_t)t->attach.pair_count * sizeof(double));
    fine.attach.pair_count = t->attach.pair_count;
    for (int32_t e = 0; e < l.count; e++) {
        int32_t u = (int32_t)(l.key[e] >> 32), v = (int32_t)(l.key[e] & 0xffffffff), fresh = old_nodes + e;
        double *x = fine.mesh.xyz + 3 * (size_t)fresh;
        vec_add(m->xyz + 3 * (size_t)u, m->xyz + 3 * (size_t)v, x);
        vec_scale(x, 0.5, x);
        fine.attach.segment[fresh] = -1;
        if (!l.outer[e]) continue;
        hang(&t->attach, u, v, &fine.attach, fresh);
        if (t->side[u] == t->side[v]) fine.side[fresh] = t->side[u];
    }
    pair_up(&t->attach, &l, old_nodes, &fine.attach);
    for (int32_t i = 0; i < m->tet_count; i++) {
        int32_t node[10];
        memcpy(node, m->tet + 4 * (size_t)i, 4 * sizeof *node);
        for (int k = 0; k < 6; k++) node[4 + k] = old_nodes + edge_at(&l, node[edge_ends[k][0]], node[edge_ends[k][1]]);
        split_tet(fine.mesh.xyz, node, fine.mesh.tet + 32 * (size_t)i);
        for (int k = 0; k < 8; k++) fine.mesh.region[8 * (size_t)i + k] = m->region[i];
    }
    free(l.key);
    free(l.outer);
    *out = fine;
}

/* Barycentric coordinates of p in four points. */
static void weights_in(const double *xyz, const int32_t v[4], const double p[3], double w[4])
{
    const double *x[4];
    for (int a = 0; a < 4; a++) x[a] = xyz + 3 * (size_t)v[a];
    double six = vec_six_volume(x[0], x[1], x[2], x[3]);
    for (int a = 0; a < 4; a++) {
        const double *y[4] = {x[0], x[1], x[2], x[3]};
        y[a] = p;
        w[a] = vec_six_volume(y[0], y[1], y[2], y[3]) / six;
    }
}

void embedding_refine(const embedding *e, const tetmesh *coarse, const tetmesh *fine, embedding *out)
{
    assert(fine->tet_count == 8 * coarse->tet_count);
    embedding r = {.point_count = e->point_count,
                   .tet = NEW_ARRAY(int32_t, e->point_count),
                   .weight = NEW_ARRAY(double, 4 * (size_t)e->point_count),
                   .max_gap_mm = e->max_gap_mm,
                   .mean_gap_mm = e->mean_gap_mm};
    for (int32_t i = 0; i < e->point_count; i++) {
        r.tet[i] = -1;
        if (e->tet[i] < 0) continue;
        double p[3] = {0}, best = -HUGE_VAL;
        for (int a = 0; a < 4; a++)
            vec_axpy(p, e->weight[4 * (size_t)i + a], coarse->xyz + 3 * (size_t)coarse->tet[4 * (size_t)e->tet[i] + a],
                     p);
        for (int k = 0; k < 8; k++) { /* the part that the point is in, or least outside of */
            double w[4], least;
            int32_t child = 8 * e->tet[i] + k;
            weights_in(fine->xyz, fine->tet + 4 * (size_t)child, p, w);
            least = fmin(fmin(w[0], w[1]), fmin(w[2], w[3]));
            if (!(least > best)) continue;
            best = least;
            r.tet[i] = child;
            memcpy(r.weight + 4 * (size_t)i, w, sizeof w);
        }
    }
    *out = r;
}
