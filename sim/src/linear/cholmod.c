#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "sim/linear.h"
#include "geometry/clock.h"
#include <assert.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

/* OpenBLAS only; other BLAS libraries keep their own setting. */
extern void openblas_set_num_threads(int) __attribute__((weak));

struct linear {
    cholmod_common common;
    cholmod_sparse matrix; /* borrows pattern and values */
    cholmod_factor *factor;
    cholmod_dense *x, *work_y, *work_e;
    bool has_factor;
    int blas_threads;
    linear_stats stats;
};

/* METIS draws from the C library's rand(), seeded at each ordering: two orderings at once would share the
 * draws, and neither be the same twice. */
static pthread_mutex_t ordering = PTHREAD_MUTEX_INITIALIZER;

static bool check_status(linear *l, const char *what, err *e)
{
    if (l->common.status >= 0) return true;
    if (l->common.status == CHOLMOD_OUT_OF_MEMORY)
        return err_set(e, ERR_RESOURCE, "not enough memory to %s %ld unknowns", what, (long)l->matrix.nrow);
    if (l->common.status == CHOLMOD_TOO_LARGE)
        return err_set(e, ERR_RESOURCE, "%ld unknowns are too many to %s", (long)l->matrix.nrow, what);
    return err_set(e, ERR_INTERNAL, "CHOLMOD status %d on trying to %s", l->common.status, what);
}

bool linear_create(int64_t unknown_count, const int64_t *start, const int64_t *row, int blas_threads, linear **out,
                   err *e)
{
    static_assert(sizeof(SuiteSparse_long) == sizeof(int64_t), "CHOLMOD long integers are 64 bits");
    assert(unknown_count > 0 && blas_threads > 0);
    double begin = clock_s();
    linear *l = NEW_ARRAY(linear, 1);
    cholmod_common *c = &l->common;
    cholmod_l_start(c);
    c->print = 0;
    c->supernodal = CHOLMOD_SUPERNODAL;
    c->final_ll = 1;
    c->quick_return_if_not_posdef = 1;
    c->nmethods = 1;
    c->method[0].ordering = CHOLMOD_METIS;
    c->postorder = 1;
    l->blas_threads = blas_threads;
    l->matrix = (cholmod_sparse){.nrow = (size_t)unknown_count,
                                 .ncol = (size_t)unknown_count,
                                 .nzmax = (size_t)start[unknown_count],
                                 .p = (void *)(uintptr_t)start,
                                 .i = (void *)(uintptr_t)row,
                                 .stype = -1,
                                 .itype = CHOLMOD_LONG,
                                 .xtype = CHOLMOD_PATTERN,
                                 .dtype = CHOLMOD_DOUBLE,
                                 .sorted = 1,
                                 .packed = 1};
    pthread_mutex_lock(&ordering);
    l->factor = cholmod_l_analyze(&l->matrix, c);
    pthread_mutex_unlock(&ordering);
    if (!check_status(l, "order", e)) {
        linear_destroy(&l);
        return false;
    }
    l->stats.unknown_count = unknown_count;
    l->stats.matrix_entries = start[unknown_count];
    l->stats.factor_entries = (int64_t)c->lnz;
    l->stats.factor_flops = c->fl;
    l->stats.analyse_s = clock_s() - begin;
    *out = l;
    return true;
}

void linear_destroy(linear **l)
{
    if (!*l) return;
    cholmod_common *c = &(*l)->common;
    cholmod_l_free_factor(&(*l)->factor, c);
    cholmod_l_free_dense(&(*l)->x, c);
    cholmod_l_free_dense(&(*l)->work_y, c);
    cholmod_l_free_dense(&(*l)->work_e, c);
    cholmod_l_finish(c);
    free(*l);
    *l = NULL;
}

bool linear_factor(linear *l, const double *value, double shift, bool *positive_definite, err *e)
{
    double begin = clock_s(), beta[2] = {shift, 0};
    if (openblas_set_num_threads) openblas_set_num_threads(l->blas_threads);
    l->matrix.x = (void *)(uintptr_t)value;
    l->matrix.xtype = CHOLMOD_REAL;
    l->has_factor = false;
    int levels = parallel_forbid();
    cholmod_l_factorize_p(&l->matrix, beta, NULL, 0, l->factor, &l->common);
    parallel_allow(levels);
    l->stats.factor_s += clock_s() - begin;
    l->stats.factorisations++;
    l->matrix.x = NULL;
    l->matrix.xtype = CHOLMOD_PATTERN;
    if (!check_status(l, "factorise", e)) return false;
    l->has_factor = l->common.status != CHOLMOD_NOT_POSDEF && l->factor->minor == l->factor->n;
    *positive_definite = l->has_factor;
    return true;
}

bool linear_solve(linear *l, const double *b, double *x, err *e)
{
    assert(l->has_factor);
    double begin = clock_s();
    if (openblas_set_num_threads) openblas_set_num_threads(l->blas_threads);
    size_t n = l->matrix.nrow;
    cholmod_dense rhs = {.nrow = n,
                         .ncol = 1,
                         .nzmax = n,
                         .d = n,
                         .x = (void *)(uintptr_t)b,
                         .xtype = CHOLMOD_REAL,
                         .dtype = CHOLMOD_DOUBLE};
    cholmod_l_solve2(CHOLMOD_A, l->factor, &rhs, NULL, &l->x, NULL, &l->work_y, &l->work_e, &l->common);
    if (!check_status(l, "solve", e)) return false;
    memcpy(x, l->x->x, n * sizeof *x);
    l->stats.solve_s += clock_s() - begin;
    l->stats.solves++;
    return true;
}

linear_stats linear_measure(const linear *l)
{
    linear_stats s = l->stats;
    s.memory_peak_mb = (double)l->common.memory_usage / 1e6;
    return s;
}
