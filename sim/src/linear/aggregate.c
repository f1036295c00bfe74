#include "sim/src/linear/aggregate.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const double strong = 0.02; /* |A_ij| against the geometric mean of |A_ii| and |A_jj| */
static const double dependent = 1e-6;

/* Squared norms of the node blocks of node i, at its columns in turn. Returns how many columns. */
static int64_t node_norms(const blocks *a, int per, int32_t i, double *norm)
{
    int64_t first = a->start[(int64_t)per * i], count = (a->start[(int64_t)per * i + 1] - first) / per;
    memset(norm, 0, (size_t)count * sizeof *norm);
    for (int r = 0; r < per; r++) {
        int64_t row = a->start[(int64_t)per * i + r];
        for (int64_t k = 0; k < count * per; k++)
            for (int c = 0; c < 9; c++) norm[k / per] += a->value[9 * (row + k) + c] * a->value[9 * (row + k) + c];
    }
    return count;
}

typedef struct graph {
    int64_t *start;
    int32_t *to;
} graph;

static graph strong_graph(const blocks *a, int per)
{
    int32_t nodes = a->rows / per;
    int64_t count = 0, room = 0;
    for (int32_t i = 0; i < a->rows; i++)
        if (a->start[i + 1] - a->start[i] > room) room = a->start[i + 1] - a->start[i];
    graph g = {NEW_ARRAY(int64_t, (size_t)nodes + 1), NEW_ARRAY(int32_t, a->start[a->rows] / (per * per))};
    double *own = NEW_ARRAY(double, nodes), *norm = NEW_ARRAY(double, room);
    for (int pass = 0; pass < 2; pass++)
        for (int32_t i = 0; i < nodes; i++) {
            int64_t columns = node_norms(a, per, i, norm), first = a->start[(int64_t)per * i];
            for (int64_t k = 0; k < columns; k++) {
                int32_t j = a->column[first + per * k] / per;
                if (pass == 0 && i == j) own[i] = norm[k];
                if (pass == 1 && i != j && norm[k] > strong * strong * sqrt(own[i] * own[j])) g.to[count++] = j;
            }
            g.start[i + 1] = count;
        }
    free(own);
    free(norm);
    return g;
}

int32_t aggregate_nodes(const blocks *a, int per, int32_t *of)
{
    int32_t nodes = a->rows / per, count = 0;
    graph g = strong_graph(a, per);
    for (int32_t i = 0; i < nodes; i++) of[i] = -1;
    for (int32_t i = 0; i < nodes; i++) { /* whole neighbourhoods */
        bool whole = of[i] < 0 && g.start[i + 1] > g.start[i];
        for (int64_t k = g.start[i]; whole && k < g.start[i + 1]; k++) whole = of[g.to[k]] < 0;
        if (!whole) continue;
        of[i] = count;
        for (int64_t k = g.start[i]; k < g.start[i + 1]; k++) of[g.to[k]] = count;
        count++;
    }
    int32_t *joined = COPY_ARRAY(int32_t, of, nodes);
    for (int32_t i = 0; i < nodes; i++) /* what is left joins one that it touches */
        for (int64_t k = g.start[i]; of[i] < 0 && joined[i] < 0 && k < g.start[i + 1]; k++) joined[i] = of[g.to[k]];
    memcpy(of, joined, (size_t)nodes * sizeof *of);
    free(joined);
    for (int32_t i = 0; i < nodes; i++) { /* or its like */
        if (of[i] >= 0 || g.start[i + 1] == g.start[i]) continue;
        of[i] = count;
        for (int64_t k = g.start[i]; k < g.start[i + 1]; k++)
            if (of[g.to[k]] < 0) of[g.to[k]] = count;
        count++;
    }
    free(g.start);
    free(g.to);
    return count;
}

/* q[rows][MODES] made orthonormal, column by column, twice; q = q_new r. Dependent columns become zero. */
static void orthonormalise(double *q, int64_t rows, double r[MODES * MODES])
{
    memset(r, 0, MODES * MODES * sizeof *r);
    for (int j = 0; j < MODES; j++) {
        double before = 0, after = 0;
        for (int64_t i = 0; i < rows; i++) before += q[MODES * i + j] * q[MODES * i + j];
        for (int pass = 0; pass < 2; pass++)
            for (int k = 0; k < j; k++) {
                double dot = 0;
                for (int64_t i = 0; i < rows; i++) dot += q[MODES * i + k] * q[MODES * i + j];
                for (int64_t i = 0; i < rows; i++) q[MODES * i + j] -= dot * q[MODES * i + k];
                r[MODES * k + j] += dot;
            }
        for (int64_t i = 0; i < rows; i++) after += q[MODES * i + j] * q[MODES * i + j];
        bool keep = after > dependent * dependent * before;
        double scale = keep ? 1 / sqrt(after) : 0;
        for (int64_t i = 0; i < rows; i++) q[MODES * i + j] *= scale;
        r[MODES * j + j] = keep ? sqrt(after) : 0;
    }
}

static blocks tentative(int per, int32_t nodes, const int32_t *of, int32_t count, const double *modes,
                        double *coarse_modes)
{
    int64_t used = 0;
    int64_t *member_start = NEW_ARRAY(int64_t, (size_t)count + 2);
    int32_t *member = NEW_ARRAY(int32_t, nodes), largest = 0;
    for (int32_t i = 0; i < nodes; i++)
        if (of[i] >= 0) member_start[of[i] + 2]++;
    for (int32_t g = 0; g < count; g++) {
        if (member_start[g + 2] > largest) largest = (int32_t)member_start[g + 2];
        member_start[g + 2] += member_start[g + 1];
    }
    for (int32_t i = 0; i < nodes; i++)
        if (of[i] >= 0) member[member_start[of[i] + 1]++] = i;
    blocks t = {.rows = per * nodes,
                .columns = 2 * count,
                .start = NEW_ARRAY(int64_t, (size_t)(per * nodes) + 1),
                .column = NEW_ARRAY(int32_t, 2 * (size_t)(per * nodes)),
                .value = NEW_ARRAY(double, 18 * (size_t)(per * nodes))};
    for (int32_t row = 0; row < t.rows; row++) {
        int32_t g = of[row / per];
        for (int h = 0; h < 2 && g >= 0; h++) t.column[used++] = 2 * g + h;
        t.start[row + 1] = used;
    }
    size_t block = 3 * MODES;
    double *q = NEW_ARRAY(double, block *(size_t)per *(size_t)largest), r[MODES * MODES];
    for (int32_t g = 0; g < count; g++) {
        int64_t first = member_start[g], size = member_start[g + 1] - first;
        for (int64_t k = 0; k < size; k++)
            memcpy(q + block * (size_t)(per * k), modes + block * (size_t)per * (size_t)member[first + k],
                   block * (size_t)per * sizeof *q);
        orthonormalise(q, 3 * per * size, r);
        memcpy(coarse_modes + (size_t)(MODES * MODES) * (size_t)g, r, sizeof r);
        for (int64_t row = 0; row < per * size; row++) {
            double *v = t.value + 9 * t.start[per * (int64_t)member[first + row / per] + row % per];
            for (int c = 0; c < 18; c++) v[c] = q[block * (size_t)row + 6 * (c % 9 / 3) + 3 * (c / 9) + c % 3];
        }
    }
    free(member_start);
    free(member);
    free(q);
    return t;
}

blocks aggregate_prolongation(const blocks *a, int per, const int32_t *of, int32_t count, const double *modes,
                              const double *inverse, double damping, double *coarse_modes)
{
    blocks t = tentative(per, a->rows / per, of, count, modes, coarse_modes), p = blocks_product(a, &t);
    for (int64_t i = 0; i < p.rows; i++) {
        int64_t own = t.start[i];
        for (int64_t k = p.start[i]; k < p.start[i + 1]; k++) {
            double w[9], *v = p.value + 9 * k;
            memcpy(w, v, sizeof w);
            bool met = own < t.start[i + 1] && t.column[own] == p.column[k];
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) {
                    const double *d = inverse + 9 * i + 3 * r;
                    v[3 * r + c] = (met ? t.value[9 * own + 3 * r + c] : 0) -
                                   damping * (d[0] * w[c] + d[1] * w[3 + c] + d[2] * w[6 + c]);
                }
            own += met;
        }
        assert(own == t.start[i + 1]);
    }
    blocks_free(&t);
    return p;
}
