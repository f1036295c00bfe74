#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/element.h"
#include "sim/scene.h"
#include "sim/src/linear/conjugate.h"
#include <stdlib.h>

/* The push of a bone is felt about twice as far as a harmonic function reaches, because the tissue it
 * displaces must go somewhere: on a whole head the moves of nodes stayed below reach sqrt(largest move times
 * harmonic value). */
static const double reach = 0.8;

/* What each edge of each tet couples, and the pairs. */
typedef struct spread {
    const tetmesh *m;
    const attach_map *a;
    double *edge, *pair; /* [6*tets], [pairs] >= 0 */
} spread;

static const int edge_of[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/* -V grad_i . grad_j of the linear tet, cut off at 0: an obtuse corner would push a neighbour the other way.
 * The gradients are the areas opposite over 3 V. */
static void weigh_tet(const tetmesh *m, int32_t t, double *weight)
{
    double area[4][3];
    const double *x[4];
    for (int k = 0; k < 4; k++) x[k] = m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)k];
    double six = vec_six_volume(x[0], x[1], x[2], x[3]);
    for (int k = 0; k < 4; k++) {
        double u[3], w[3];
        const int *f = tet_face[k];
        vec_sub(x[f[1]], x[f[0]], u);
        vec_sub(x[f[2]], x[f[0]], w);
        vec_cross(u, w, area[k]);
    }
    for (int k = 0; k < 6; k++) weight[k] = fmax(0, -vec_dot(area[edge_of[k][0]], area[edge_of[k][1]]) / (6 * six));
}

static void apply(const double *x, double *out, void *context)
{
    const spread *s = context;
    for (int32_t v = 0; v < s->m->vertex_count; v++) out[v] = 0;
    for (int32_t t = 0; t < s->m->tet_count; t++)
        for (int k = 0; k < 6; k++) {
            const int32_t *v = s->m->tet + 4 * (size_t)t;
            int32_t i = v[edge_of[k][0]], j = v[edge_of[k][1]];
            double flow = s->edge[6 * (size_t)t + (size_t)k] * (x[i] - x[j]);
            out[i] += flow;
            out[j] -= flow;
        }
    for (int32_t p = 0; p < s->a->pair_count; p++) {
        int32_t i = s->a->pair[2 * (size_t)p], j = s->a->pair[2 * (size_t)p + 1];
        double flow = s->pair[p] * (x[i] - x[j]);
        out[i] += flow;
        out[j] -= flow;
    }
}

void scene_estimate(const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT], double *estimate)
{
    spread s = {m, a, NEW_ARRAY(double, 6 * (size_t)m->tet_count), NEW_ARRAY(double, a->pair_count)};
    double largest = 0, *diagonal = NEW_ARRAY(double, m->vertex_count), *b = NEW_ARRAY(double, m->vertex_count);
    for (int32_t t = 0; t < m->tet_count; t++) {
        weigh_tet(m, t, s.edge + 6 * (size_t)t);
        for (int k = 0; k < 6; k++)
            for (int end = 0; end < 2; end++)
                diagonal[m->tet[4 * (size_t)t + (size_t)edge_of[k][end]]] += s.edge[6 * (size_t)t + (size_t)k];
    }
    for (int32_t p = 0; p < a->pair_count; p++) { /* lips that touch move together */
        int32_t i = a->pair[2 * (size_t)p], j = a->pair[2 * (size_t)p + 1];
        s.pair[p] = fmax(diagonal[i], diagonal[j]);
        diagonal[i] += s.pair[p];
        diagonal[j] += s.pair[p];
    }
    for (int32_t v = 0; v < m->vertex_count; v++) {
        estimate[v] = 0;
        if (a->kind[v] == NODE_FREE) continue;
        double at[3], rest[3];
        rigid_apply(&motion[a->segment[v]], m->xyz + 3 * (size_t)v, at);
        rigid_apply(&motion[SEGMENT_CRANIUM], m->xyz + 3 * (size_t)v, rest);
        double moved = vec_distance(at, rest);
        if (a->kind[v] == NODE_SLIDING && !(moved > 0)) continue; /* on a bone that stays: can be dragged along it */
        estimate[v] = moved;
        largest = fmax(largest, moved);
        diagonal[v] = 0;
    }
    apply(estimate, b, &s);
    double *rest = NEW_ARRAY(double, m->vertex_count);
    for (int32_t v = 0; v < m->vertex_count; v++) b[v] = -b[v];
    conjugate_solve(m->vertex_count, apply, &s, diagonal, b, rest, 1e-5, 1000);
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (diagonal[v] > 0) estimate[v] = fmin(largest, reach * sqrt(largest * fmax(0, estimate[v] + rest[v])));
    free(rest);
    free(b);
    free(diagonal);
    free(s.edge);
    free(s.pair);
}
