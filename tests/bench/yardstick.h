/* yardstick: one CHOLMOD ordering (METIS), assembly, supernodal factorisation and solve of the linear-elastic
 * matrix, and how time is taken. */
#pragma once
#include "geometry/mem.h"
#include "geometry/clock.h"
#include "sim/src/solve/descent.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

typedef struct spent {
    double wall_s, cpu_s;
} spent;

static inline spent time_now(void)
{
    struct rusage r;
    getrusage(RUSAGE_SELF, &r);
    return (spent){clock_s(), (double)(r.ru_utime.tv_sec + r.ru_stime.tv_sec) +
                                  1e-6 * (double)(r.ru_utime.tv_usec + r.ru_stime.tv_usec)};
}

static inline spent time_since(spent begin)
{
    spent now = time_now();
    return (spent){now.wall_s - begin.wall_s, now.cpu_s - begin.cpu_s};
}

static inline void give_up(const err *e)
{
    fprintf(stderr, "%s\n", e->text);
    exit(1);
}

/* blas_threads: the yardstick may use what the solver may use. */
static inline spent linear_solve_once(const equilibrium_problem *p, int blas_threads)
{
    err e = {0};
    solver *t = NULL;
    bool positive;
    spent begin = time_now();
    if (!solver_create(p, blas_threads, &t, &e) || !solver_order(t, &e)) give_up(&e);
    double *b = NEW_ARRAY(double, t->b.unknown_count);
    for (int32_t i = 0; i < t->b.unknown_count; i++) b[i] = 1;
    assembly_stiffness(&t->a, p->mesh->xyz, PROJECTION_NONE);
    assembly_matrix(&t->a, &t->b);
    if (!linear_factor(t->l, t->a.value, 0, &positive, &e) || !positive || !linear_solve(t->l, b, b, &e)) give_up(&e);
    spent out = time_since(begin);
    linear_stats s = linear_measure(t->l);
    fprintf(stderr, "one linear solve: %.2f s (CPU %.2f), ordering %.2f, factor %.2f, solve %.3f, %.1f GFLOP\n",
            out.wall_s, out.cpu_s, s.analyse_s, s.factor_s, s.solve_s, s.factor_flops * 1e-9);
    free(b);
    solver_destroy(&t);
    return out;
}

/* The least of three, after one that touches the memory first. */
static inline spent one_linear_solve(const equilibrium_problem *p, int blas_threads)
{
    (void)linear_solve_once(p, blas_threads);
    spent least = linear_solve_once(p, blas_threads);
    for (int k = 0; k < 2; k++) {
        spent one = linear_solve_once(p, blas_threads);
        least.wall_s = fmin(least.wall_s, one.wall_s);
        least.cpu_s = fmin(least.cpu_s, one.cpu_s);
    }
    return least;
}
