#include "sim/src/linear/cg.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SUM_GRAIN = 32768 };

typedef struct sum_job {
    const double *a, *b;
    double *part;
} sum_job;

static void sum_body(int64_t begin, int64_t end, void *context)
{
    const sum_job *job = context;
    double sum = 0;
    for (int64_t i = begin; i < end; i++) sum += job->a[i] * job->b[i];
    job->part[begin / SUM_GRAIN] = sum;
}

/* Sums of fixed stretches, added in order. */
static double dot(const double *a, const double *b, int64_t n, double *part)
{
    sum_job job = {a, b, part};
    parallel_for(n, SUM_GRAIN, sum_body, &job);
    double sum = 0;
    for (int64_t k = 0; k * SUM_GRAIN < n; k++) sum += part[k];
    return sum;
}

typedef struct step_job {
    double *x, *r;
    const double *p, *ap;
    double alpha;
} step_job;

static void step_body(int64_t begin, int64_t end, void *context)
{
    const step_job *job = context;
    for (int64_t i = begin; i < end; i++) {
        job->x[i] += job->alpha * job->p[i];
        job->r[i] -= job->alpha * job->ap[i];
    }
}

bool cg_solve(const blocks *a, multigrid *m, const double *b, double *x, double rel_tol, int max_iterations,
              cg_result *out, err *e)
{
    int64_t n = 3 * (int64_t)a->rows;
    double *part = NEW_ARRAY(double, n / SUM_GRAIN + 1), *r = COPY_ARRAY(double, b, n);
    double *z = NEW_ARRAY(double, n), *p = NEW_ARRAY(double, n), *ap = NEW_ARRAY(double, n), rz = 0;
    double start = sqrt(dot(b, b, n, part)), now = start;
    bool ok = true;
    *out = (cg_result){.reduction = 1};
    memset(x, 0, (size_t)n * sizeof *x);
    while (ok && now > rel_tol * start && out->iterations < max_iterations) {
        if (!(ok = multigrid_apply(m, r, z, e))) break;
        double next = dot(r, z, n, part);
        if (!(next > 0)) break; /* the preconditioner is not positive definite */
        double beta = out->iterations ? next / rz : 0;
        rz = next;
        for (int64_t i = 0; i < n; i++) p[i] = z[i] + beta * p[i];
        blocks_multiply(a, p, ap);
        double curvature = dot(p, ap, n, part);
        if (!(curvature > 0)) {
            out->indefinite = true;
            if (out->iterations == 0) memcpy(x, p, (size_t)n * sizeof *x);
            break;
        }
        step_job job = {x, r, p, ap, rz / curvature};
        parallel_for(n, SUM_GRAIN, step_body, &job);
        now = sqrt(dot(r, r, n, part));
        out->reduction = now / start;
        out->iterations++;
    }
    double *all[] = {part, r, z, p, ap};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
    return ok;
}
