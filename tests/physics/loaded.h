/* loaded: equilibrium under given nodal forces, which the solver itself does not know: Newton's method with
 * the assembly's own forces and matrix. */
#pragma once
#include "tests/check.h"
#include "sim/src/solve/descent.h"
#include "tests/physics/block.h"

/* Squared residual of the unknowns at x, in g. */
static inline double loaded_residual(solver *t, const double *load, double part, const double *x, double *g)
{
    size_t n = 3 * (size_t)t->b.node_count;
    double *f = NEW_ARRAY(double, n), sum = 0;
    assembly_energy(&t->a, x, f);
    for (size_t i = 0; i < n; i++) f[i] -= part * load[i];
    boundary_reduce(&t->b, f, g);
    for (int32_t i = 0; i < t->b.unknown_count; i++) sum += g[i] * g[i];
    free(f);
    return sum;
}

/* x[3*nodes] from where all unknowns are zero, under load[3*nodes] mN in so many equal parts, each to 1e-10
 * of its first residual. loads 0: a single step, the answer of linear elasticity. Returns the steps at the
 * last part. */
static inline int loaded_solve(solver *t, const double *load, int loads, double *x)
{
    err e = {0};
    double *z = NEW_ARRAY(double, t->b.unknown_count), *g = NEW_ARRAY(double, t->b.unknown_count);
    int steps = 0, most = loads ? 20 : 1;
    assert_ok(solver_order(t, &e));
    boundary_place(&t->b, z, x);
    for (int part = 1; part <= loads || part == 1; part++) {
        double share = loads ? (double)part / loads : 1, now = loaded_residual(t, load, share, x, g), first = now;
        for (steps = 0; now > 1e-16 * first && steps < most; steps++) {
            bool positive;
            assembly_stiffness(&t->a, x, PROJECTION_NONE);
            assembly_matrix(&t->a, &t->b);
            assert_ok(linear_factor(t->l, t->a.value, 0, &positive, &e));
            assert_true(positive);
            assert_ok(linear_solve(t->l, g, g, &e));
            for (int32_t i = 0; i < t->b.unknown_count; i++) z[i] -= g[i];
            boundary_place(&t->b, z, x);
            now = loaded_residual(t, load, share, x, g);
        }
        assert_true(!loads || now <= 1e-16 * first);
    }
    free(z);
    free(g);
    return steps;
}
