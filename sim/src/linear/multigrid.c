#include "sim/src/linear/multigrid.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/linear.h"
#include "sim/src/linear/aggregate.h"
#include "sim/src/linear/smoother.h"
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 12, COARSEST = 400 /* blocks */ };

struct multigrid {
    int level_count;
    level level[LEVELS];
    float *b;                          /* of the first level */
    int64_t direct_size, *start, *row; /* of the last level */
    double *value, *side;
    linear *direct;
};

/* Directions without stiffness (constrained ones, modes that an aggregate lacks) become those of the
 * identity; nothing is ever asked of them. */
static void fill_empty(blocks *a)
{
    for (int64_t i = 0; i < a->rows; i++)
        for (int64_t k = a->start[i]; k < a->start[i + 1]; k++)
            for (int c = 0; c < 3 && a->column[k] == i; c++)
                if (a->value[9 * k + 4 * c] == 0) a->value[9 * k + 4 * c] = 1;
}

static void invert(const double m[9], double out[9])
{
    double det = mat_det(m), c[9];
    vec_cross(m + 3, m + 6, c);
    vec_cross(m + 6, m, c + 3);
    vec_cross(m, m + 3, c + 6);
    for (int i = 0; i < 9; i++) out[i] = c[3 * (i % 3) + i / 3] / det;
}

/* Of the diagonal blocks; false: one is not positive definite. */
static bool find_inverse(const blocks *a, double *inverse)
{
    bool definite = true;
    for (int64_t i = 0; i < a->rows; i++)
        for (int64_t k = a->start[i]; k < a->start[i + 1]; k++) {
            const double *m = a->value + 9 * k;
            if (a->column[k] != i) continue;
            definite = definite && m[0] > 0 && m[0] * m[4] - m[1] * m[3] > 0 && mat_det(m) > 0;
            invert(m, inverse + 9 * i);
        }
    return definite;
}

static void make_vectors(level *l, bool first)
{
    size_t n = 3 * (size_t)l->a.rows;
    l->x = NEW_ARRAY(float, n);
    l->y = NEW_ARRAY(float, n);
    l->d = NEW_ARRAY(float, n);
    if (!first) l->b = NEW_ARRAY(float, n);
}

/* The next level and its modes; false: it would be no smaller. */
static bool coarsen(level *l, int blocks_per_node, const double *modes, const double *inverse, blocks *next,
                    double **next_modes)
{
    int32_t *of = NEW_ARRAY(int32_t, l->a.rows / blocks_per_node);
    int32_t count = aggregate_nodes(&l->a, blocks_per_node, of);
    bool worth = count > 0 && 8 * (int64_t)count <= 3 * (int64_t)l->a.rows;
    if (worth) {
        *next_modes = NEW_ARRAY(double, 36 * (size_t)count);
        l->p = aggregate_prolongation(&l->a, blocks_per_node, of, count, modes, inverse, 4 / (3 * l->top), *next_modes);
        l->r = blocks_transposed(&l->p);
        blocks ap = blocks_product(&l->a, &l->p);
        *next = blocks_product(&l->r, &ap);
        blocks_free(&ap);
        fill_empty(next);
        blocks_round(&l->p);
        blocks_round(&l->r);
        blocks_keep_single(&l->p);
        blocks_keep_single(&l->r);
    }
    free(of);
    return worth;
}

/* The last level; its lower triangle by columns is the upper one by rows. */
static bool factorise(multigrid *m, bool *definite, err *e)
{
    const blocks *a = &m->level[m->level_count - 1].a;
    int64_t n = m->direct_size = 3 * (int64_t)a->rows, count = 0;
    m->start = NEW_ARRAY(int64_t, (size_t)n + 1);
    m->row = NEW_ARRAY(int64_t, 9 * a->start[a->rows]);
    m->value = NEW_ARRAY(double, 9 * a->start[a->rows]);
    m->side = NEW_ARRAY(double, n);
    for (int64_t j = 0; j < n; j++) {
        for (int64_t k = a->start[j / 3]; k < a->start[j / 3 + 1]; k++)
            for (int c = 0; c < 3; c++) {
                int64_t i = 3 * (int64_t)a->column[k] + c;
                if (i < j) continue;
                m->row[count] = i;
                m->value[count++] = a->value[9 * k + 3 * (j % 3) + c];
            }
        m->start[j + 1] = count;
    }
    return linear_create(n, m->start, m->row, 1, &m->direct, e) && linear_factor(m->direct, m->value, 0, definite, e);
}

bool multigrid_make(const blocks *a, const double *modes, multigrid **out, bool *definite, err *e)
{
    multigrid *m = NEW_ARRAY(multigrid, 1);
    int64_t entries = a->start[a->rows];
    double *own_modes = NULL;
    *definite = true;
    m->b = NEW_ARRAY(float, 3 * (size_t)a->rows);
    m->level[0].a = (blocks){.rows = a->rows,
                             .columns = a->columns,
                             .start = COPY_ARRAY(int64_t, a->start, (size_t)a->rows + 1),
                             .column = COPY_ARRAY(int32_t, a->column, entries),
                             .value = COPY_ARRAY(double, a->value, 9 * entries)};
    fill_empty(&m->level[0].a);
    for (bool more = true; more && *definite;) {
        level *l = &m->level[m->level_count++];
        make_vectors(l, m->level_count == 1);
        if (l->a.rows <= COARSEST || m->level_count == LEVELS) break;
        double *inverse = NEW_ARRAY(double, 9 * (size_t)l->a.rows), *next_modes = NULL;
        *definite = find_inverse(&l->a, inverse);
        l->inverse = NEW_ARRAY(float, 9 * (size_t)l->a.rows);
        for (int64_t i = 0; i < 9 * (int64_t)l->a.rows; i++) l->inverse[i] = (float)inverse[i];
        if (*definite) smoother_make(l);
        more = *definite &&
               coarsen(l, m->level_count == 1 ? 1 : 2, own_modes ? own_modes : modes, inverse, &l[1].a, &next_modes);
        if (more) {
            blocks_keep_single(&l->a);
            free(own_modes);
            own_modes = next_modes;
        }
        free(inverse);
    }
    free(own_modes);
    bool ok = !*definite || factorise(m, definite, e);
    if (!ok || !*definite) multigrid_destroy(&m);
    *out = m;
    return ok;
}

void multigrid_destroy(multigrid **m)
{
    if (!*m) return;
    for (int k = 0; k < LEVELS; k++) {
        level *l = &(*m)->level[k];
        float *all[] = {l->inverse, l->b, l->x, l->y, l->d};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
        blocks_free(&l->a);
        blocks_free(&l->p);
        blocks_free(&l->r);
    }
    free((*m)->b);
    free((*m)->start);
    free((*m)->row);
    free((*m)->value);
    free((*m)->side);
    linear_destroy(&(*m)->direct);
    free(*m);
    *m = NULL;
}

/* The level's x from b. */
static bool cycle(multigrid *m, int k, const float *b, err *e)
{
    level *l = &m->level[k];
    if (k == m->level_count - 1) {
        for (int64_t i = 0; i < m->direct_size; i++) m->side[i] = (double)b[i];
        if (!linear_solve(m->direct, m->side, m->side, e)) return false;
        for (int64_t i = 0; i < m->direct_size; i++) l->x[i] = (float)m->side[i];
        return true;
    }
    smoother_apply(l, b, true);
    smoother_residual(l, b);
    smoother_multiply(&l->r, l->y, l[1].b);
    if (!cycle(m, k + 1, l[1].b, e)) return false;
    smoother_multiply_add(&l->p, l[1].x, l->x);
    smoother_apply(l, b, false);
    return true;
}

bool multigrid_apply(multigrid *m, const double *b, double *x, err *e)
{
    int64_t n = 3 * (int64_t)m->level[0].a.rows;
    for (int64_t i = 0; i < n; i++) m->b[i] = (float)b[i];
    if (!cycle(m, 0, m->b, e)) return false;
    for (int64_t i = 0; i < n; i++) x[i] = (double)m->level[0].x[i];
    return true;
}

double multigrid_mb(const multigrid *m)
{
    double bytes = linear_measure(m->direct).memory_peak_mb * 1e6;
    for (int k = 0; k < m->level_count; k++) {
        const blocks *all[] = {&m->level[k].a, &m->level[k].p, &m->level[k].r};
        bytes += 21 * 4.0 * all[0]->rows;
        for (int i = 0; i < 3; i++)
            if (all[i]->start) bytes += 40.0 * (double)all[i]->start[all[i]->rows] + 8.0 * all[i]->rows;
    }
    return bytes / 1e6;
}
