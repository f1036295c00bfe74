#include "sim/boundary.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/motion.h"
#include "sim/src/solve/restraint.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static bool is_unit(const double n[3]) { return fabs(vec_norm(n) - 1) < 1e-6; }

static bool check_map(const tetmesh *m, const attach_map *a, err *e)
{
    if (a->node_count != m->vertex_count)
        return err_set(e, ERR_INPUT, "the attachment map has %d nodes, the mesh %d", a->node_count, m->vertex_count);
    for (int32_t v = 0; v < a->node_count; v++) {
        if (a->kind[v] > NODE_SLIDING) return err_set(e, ERR_INPUT, "node %d has no known kind (%d)", v, a->kind[v]);
        if (a->kind[v] == NODE_FREE) continue;
        if (a->segment[v] < 0 || a->segment[v] >= SEGMENT_COUNT)
            return err_set(e, ERR_INPUT, "node %d hangs on segment %d, which does not exist", v, a->segment[v]);
        if (a->kind[v] == NODE_SLIDING && !is_unit(a->normal + 3 * (size_t)v))
            return err_set(e, ERR_INPUT, "the normal of sliding node %d is not of length 1", v);
    }
    int32_t *seen = NEW_ARRAY(int32_t, a->node_count); /* 1 + number of the node's pair */
    bool ok = true;
    for (int32_t i = 0; ok && i < 2 * a->pair_count; i++) {
        int32_t v = a->pair[i];
        if (v < 0 || v >= a->node_count)
            ok = err_set(e, ERR_INPUT, "pair %d names node %d, out of range", i / 2, v);
        else if (a->kind[v] != NODE_FREE)
            ok = err_set(e, ERR_INPUT, "node %d is in pair %d but hangs on bone too", v, i / 2);
        else if (seen[v])
            ok = err_set(e, ERR_INPUT, "node %d is in two pairs", v);
        else if (!is_unit(a->pair_normal + 3 * (size_t)(i / 2)))
            ok = err_set(e, ERR_INPUT, "the normal of pair %d is not of length 1", i / 2);
        else
            seen[v] = 1 + i / 2;
    }
    for (int32_t i = 0; ok && i < m->tet_count; i++)
        for (int k = 0; ok && k < 6; k++) {
            static const int edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
            int32_t u = m->tet[4 * (size_t)i + edge[k][0]], v = m->tet[4 * (size_t)i + edge[k][1]];
            if (seen[u] && seen[u] == seen[v])
                ok = err_set(e, ERR_INPUT, "tet %d holds both nodes of pair %d", i, seen[u] - 1);
        }
    free(seen);
    return ok;
}

/* n and two directions across it, chosen by n alone. */
static void frame_about(const double n[3], double basis[9])
{
    int small = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(n[c]) < fabs(n[small])) small = c;
    double axis[3] = {0};
    axis[small] = 1;
    vec_copy(n, basis);
    vec_normalize(basis);
    vec_cross(basis, axis, basis + 3);
    vec_normalize(basis + 3);
    vec_cross(basis, basis + 3, basis + 6);
}

bool boundary_make(const tetmesh *m, const attach_map *a, boundary *out, err *e)
{
    return boundary_make_drawn(m, a, NULL, out, e);
}

bool boundary_make_drawn(const tetmesh *m, const attach_map *a, const targets *t, boundary *out, err *e)
{
    if (!check_map(m, a, e) || !restraint_check(m, a, t, e)) return false;
    int32_t n = m->vertex_count;
    boundary b = {.node_count = n,
                  .unknown = NEW_ARRAY(int32_t, 3 * (size_t)n),
                  .plain = NEW_ARRAY(uint8_t, n),
                  .origin = NEW_ARRAY(double, 3 * (size_t)n),
                  .basis = NEW_ARRAY(double, 9 * (size_t)n)};
    int32_t *partner = NEW_ARRAY(int32_t, n);
    for (int32_t v = 0; v < n; v++) {
        partner[v] = -1;
        b.plain[v] = a->kind[v] == NODE_FREE;
    }
    for (int32_t i = 0; i < a->pair_count; i++) {
        int32_t u = a->pair[2 * i], l = a->pair[2 * i + 1];
        partner[u] = l;
        partner[l] = u;
        b.plain[u] = b.plain[l] = 0;
    }
    for (int32_t v = 0; v < n; v++)
        for (int k = 0; k < 3; k++) {
            bool prescribed = a->kind[v] == NODE_TIED || (a->kind[v] == NODE_SLIDING && k == 0);
            bool shared = k == 0 && partner[v] >= 0 && partner[v] < v; /* numbered at the other node already */
            b.unknown[3 * (size_t)v + k] = prescribed ? -1
                                           : shared   ? b.unknown[3 * (size_t)partner[v]]
                                                      : b.unknown_count++;
        }
    free(partner);
    rigid rest[SEGMENT_COUNT];
    for (int s = 0; s < SEGMENT_COUNT; s++) rest[s] = rigid_identity();
    boundary_move(&b, m, a, rest);
    *out = b;
    return true;
}

void boundary_free(boundary *b)
{
    free(b->unknown);
    free(b->plain);
    free(b->origin);
    free(b->basis);
    *b = (boundary){0};
}

/* The motion shared by all prescribed nodes, or else the best fit. */
static rigid find_guide(const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT])
{
    const rigid *first = NULL;
    bool same = true;
    int64_t count = 0;
    for (int32_t v = 0; v < a->node_count; v++) {
        if (a->kind[v] == NODE_FREE) continue;
        const rigid *t = &motion[a->segment[v]];
        if (!first) first = t;
        if (memcmp(t, first, sizeof *t) != 0) same = false;
        count++;
    }
    if (!first) return rigid_identity();
    if (same) return *first;
    double *from = NEW_ARRAY(double, 3 * (size_t)count), *to = NEW_ARRAY(double, 3 * (size_t)count);
    count = 0;
    for (int32_t v = 0; v < a->node_count; v++) {
        if (a->kind[v] == NODE_FREE) continue;
        vec_copy(m->xyz + 3 * (size_t)v, from + 3 * count);
        rigid_apply(&motion[a->segment[v]], m->xyz + 3 * (size_t)v, to + 3 * count);
        count++;
    }
    rigid fit = motion_fit(from, to, count);
    free(from);
    free(to);
    return fit;
}

void boundary_move(boundary *b, const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT])
{
    static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    assert(b->node_count == m->vertex_count && a->node_count == m->vertex_count);
    b->guide = find_guide(m, a, motion);
    for (int32_t v = 0; v < b->node_count; v++) {
        const double *X = m->xyz + 3 * (size_t)v;
        double *origin = b->origin + 3 * (size_t)v, *basis = b->basis + 9 * (size_t)v;
        memcpy(basis, unit, sizeof unit);
        if (a->kind[v] == NODE_FREE)
            vec_copy(X, origin);
        else
            rigid_apply(&motion[a->segment[v]], X, origin);
        if (a->kind[v] != NODE_SLIDING) continue;
        frame_about(a->normal + 3 * (size_t)v, basis);
        for (int k = 0; k < 3; k++) rigid_rotate(&motion[a->segment[v]], basis + 3 * k, basis + 3 * k);
        if (a->shift_mm) vec_axpy(origin, a->shift_mm[v], basis, origin);
    }
    for (int32_t i = 0; i < 2 * a->pair_count; i++) {
        size_t v = (size_t)a->pair[i];
        double *basis = b->basis + 9 * v;
        rigid_apply(&b->guide, m->xyz + 3 * v, b->origin + 3 * v);
        frame_about(a->pair_normal + 3 * (size_t)(i / 2), basis);
        for (int k = 0; k < 3; k++) rigid_rotate(&b->guide, basis + 3 * k, basis + 3 * k);
    }
}

void boundary_place(const boundary *b, const double *z, double *x)
{
    for (int32_t v = 0; v < b->node_count; v++) {
        double *p = x + 3 * (size_t)v;
        vec_copy(b->origin + 3 * (size_t)v, p);
        for (int k = 0; k < 3; k++) {
            int32_t q = b->unknown[3 * (size_t)v + k];
            if (q < 0) continue;
            if (b->plain[v])
                p[k] += z[q];
            else
                vec_axpy(p, z[q], b->basis + 9 * (size_t)v + 3 * k, p);
        }
    }
}

void boundary_project(const boundary *b, const double *x, double *z)
{
    /* Unknowns are numbered along the nodes, so a shared one is met again after its first value is there. */
    int32_t next = 0;
    for (int32_t v = 0; v < b->node_count; v++)
        for (int k = 0; k < 3; k++) {
            int32_t q = b->unknown[3 * (size_t)v + k];
            if (q < 0) continue;
            double d[3];
            vec_sub(x + 3 * (size_t)v, b->origin + 3 * (size_t)v, d);
            double value = b->plain[v] ? d[k] : vec_dot(d, b->basis + 9 * (size_t)v + 3 * k);
            if (q == next) {
                z[q] = value;
                next++;
            } else
                z[q] = (z[q] + value) / 2;
        }
    assert(next == b->unknown_count);
}

void boundary_reduce(const boundary *b, const double *force, double *g)
{
    memset(g, 0, (size_t)b->unknown_count * sizeof *g);
    for (int32_t v = 0; v < b->node_count; v++)
        for (int k = 0; k < 3; k++) {
            int32_t q = b->unknown[3 * (size_t)v + k];
            if (q < 0) continue;
            g[q] += b->plain[v] ? force[3 * (size_t)v + k]
                                : vec_dot(force + 3 * (size_t)v, b->basis + 9 * (size_t)v + 3 * k);
        }
}
