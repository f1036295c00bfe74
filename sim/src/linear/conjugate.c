#include "sim/src/linear/conjugate.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double *a, const double *b, int64_t n)
{
    double sum = 0;
    for (int64_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* z = r / diagonal; zero where there is none */
static void precondition(int64_t n, const double *diagonal, const double *r, double *z)
{
    for (int64_t i = 0; i < n; i++) z[i] = diagonal[i] > 0 ? r[i] / diagonal[i] : 0;
}

int conjugate_solve(int64_t n, conjugate_apply *apply, void *context, const double *diagonal, const double *b,
                    double *x, double rel_tol, int max_iterations)
{
    double *r = NEW_ARRAY(double, n), *z = NEW_ARRAY(double, n), *p = NEW_ARRAY(double, n), *q = NEW_ARRAY(double, n);
    precondition(n, diagonal, b, z);
    double target = rel_tol * sqrt(fabs(dot(b, z, n)));
    apply(x, q, context);
    for (int64_t i = 0; i < n; i++) r[i] = diagonal[i] > 0 ? b[i] - q[i] : 0;
    precondition(n, diagonal, r, z);
    memcpy(p, z, (size_t)n * sizeof *p);
    double rz = dot(r, z, n);
    int iteration = 0;
    for (; iteration < max_iterations && sqrt(fabs(rz)) > target; iteration++) {
        apply(p, q, context);
        for (int64_t i = 0; i < n; i++)
            if (!(diagonal[i] > 0)) q[i] = 0;
        double alpha = rz / dot(p, q, n);
        for (int64_t i = 0; i < n; i++) {
            x[i] += alpha * p[i];
            r[i] -= alpha * q[i];
        }
        precondition(n, diagonal, r, z);
        double next = dot(r, z, n), beta = next / rz;
        for (int64_t i = 0; i < n; i++) p[i] = z[i] + beta * p[i];
        rz = next;
    }
    free(r);
    free(z);
    free(p);
    free(q);
    return iteration;
}
