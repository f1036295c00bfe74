#include "sim/src/solve/restraint.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/elastic/svd3.h"
#include <stdlib.h>

static int32_t root_of(int32_t *parent, int32_t v)
{
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

/* One row per held direction n at point p: n . (translation + rotation x p) = 0. */
static void add_row(double gram[36], const double n[3], const double p[3])
{
    double row[6];
    vec_copy(n, row);
    vec_cross(p, n, row + 3);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) gram[6 * i + j] += row[i] * row[j];
}

/* The parts of the mesh that hang together. */
typedef struct parts {
    int32_t count, *of; /* [nodes] the part of each */
    int32_t *size;      /* [count] nodes */
    double *centre;     /* [3*count] mean of its nodes, mm */
    double *reach;      /* [count] farthest node from there, mm */
} parts;

static void parts_free(parts *p)
{
    free(p->of);
    free(p->size);
    free(p->centre);
    free(p->reach);
    *p = (parts){0};
}

static bool check_used(const tetmesh *m, err *e)
{
    int32_t loose = 0, first = -1;
    uint8_t *used = NEW_ARRAY(uint8_t, m->vertex_count);
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) used[m->tet[i]] = 1;
    for (int32_t v = m->vertex_count - 1; v >= 0; v--)
        if (!used[v]) {
            first = v;
            loose++;
        }
    free(used);
    return loose == 0 || err_set(e, ERR_GEOMETRY, "%d mesh nodes are in no tet, the first is node %d", loose, first);
}

/* Numbered by their lowest nodes. */
static parts find_parts(const tetmesh *m)
{
    int32_t n = m->vertex_count, *parent = NEW_ARRAY(int32_t, n);
    parts p = {.of = NEW_ARRAY(int32_t, n)};
    for (int32_t v = 0; v < n; v++) parent[v] = v;
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            int32_t r = root_of(parent, m->tet[4 * (size_t)t + (size_t)k]);
            int32_t s = root_of(parent, m->tet[4 * (size_t)t]);
            if (r < s)
                parent[s] = r;
            else
                parent[r] = s;
        }
    for (int32_t v = 0; v < n; v++) p.of[v] = parent[v] == v ? p.count++ : p.of[root_of(parent, v)];
    free(parent);
    p.size = NEW_ARRAY(int32_t, p.count);
    p.centre = NEW_ARRAY(double, 3 * (size_t)p.count);
    p.reach = NEW_ARRAY(double, p.count);
    for (int32_t v = 0; v < n; v++) {
        double *centre = p.centre + 3 * (size_t)p.of[v];
        p.size[p.of[v]]++;
        vec_add(centre, m->xyz + 3 * (size_t)v, centre);
    }
    for (size_t i = 0; i < (size_t)p.count; i++) vec_scale(p.centre + 3 * i, 1.0 / p.size[i], p.centre + 3 * i);
    for (int32_t v = 0; v < n; v++) {
        double far = vec_distance(m->xyz + 3 * (size_t)v, p.centre + 3 * (size_t)p.of[v]);
        p.reach[p.of[v]] = fmax(p.reach[p.of[v]], far);
    }
    return p;
}

/* [36*parts] of the held directions, in units of each part's reach about its centre. The caller frees. */
static double *gather_rows(const tetmesh *m, const attach_map *a, const targets *t, const parts *p)
{
    static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double *gram = NEW_ARRAY(double, 36 * (size_t)p->count);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        size_t part = (size_t)p->of[v];
        double at[3];
        vec_sub(m->xyz + 3 * (size_t)v, p->centre + 3 * part, at);
        vec_scale(at, 1 / p->reach[part], at);
        if (a->kind[v] == NODE_TIED)
            for (int c = 0; c < 3; c++) add_row(gram + 36 * part, axis[c], at);
        if (a->kind[v] == NODE_SLIDING) add_row(gram + 36 * part, a->normal + 3 * (size_t)v, at);
    }
    for (int32_t k = 0; t && k < t->count; k++) {
        size_t part = (size_t)p->of[m->tet[4 * (size_t)t->tet[k]]];
        double at[3];
        if (!(t->stiffness[k] > 0)) continue;
        targets_point(t, m, m->xyz, k, at);
        vec_sub(at, p->centre + 3 * part, at);
        vec_scale(at, 1 / p->reach[part], at);
        add_row(gram + 36 * part, t->normal + 3 * (size_t)k, at);
        for (int c = 0; t->across[k] > 0 && c < 3; c++) add_row(gram + 36 * part, axis[c], at);
    }
    return gram;
}

/* Rigid motions that no row resists; gram is used up. */
static int count_free_moves(double gram[36])
{
    double value[6], Q[36];
    int count = 0;
    symmetric_eigen(6, gram, value, Q);
    for (int k = 0; k < 6; k++) count += !(value[k] > 1e-8); /* rows are of order one: 1e-4 in length */
    return count;
}

bool restraint_check(const tetmesh *m, const attach_map *a, const targets *t, err *e)
{
    if (!check_used(m, e)) return false;
    parts p = find_parts(m);
    double *gram = gather_rows(m, a, t, &p);
    bool ok = true;
    for (int32_t i = 0; ok && i < p.count; i++) {
        int free_moves = count_free_moves(gram + 36 * (size_t)i);
        const double *c = p.centre + 3 * (size_t)i;
        if (free_moves > 0)
            ok = err_set(e, ERR_GEOMETRY,
                         "a part of the tissue is not held by bone%s: %d of its 6 rigid motions are free (%d of %d "
                         "nodes, about %.1f %.1f %.1f mm, radius %.1f mm, %d parts in all)",
                         t ? " or targets" : "", free_moves, p.size[i], m->vertex_count, c[0], c[1], c[2], p.reach[i],
                         p.count);
    }
    free(gram);
    parts_free(&p);
    return ok;
}
