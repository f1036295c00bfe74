/* manufactured: a body whose exact large deformation is known, because the forces in it are chosen so (method
 * of manufactured solutions): u(X) on the cube of 10 mm, its whole surface prescribed. */
#pragma once
#include "tests/check.h"
#include "sim/src/descent.h"
#include "tests/physics/block.h"
#include <string.h>

enum { MANUFACTURED_MM = 10 };

static inline void manufactured_u(const double X[3], double u[3])
{
    double k = 3.14159265358979 / MANUFACTURED_MM, a = 0.5;
    u[0] = a * sin(k * X[1]) * cos(k * X[2]) + 0.4 * a * sin(k * X[0]);
    u[1] = a * cos(2 * k * X[0]) * sin(k * X[2]);
    u[2] = a * sin(k * (X[0] + X[1])) - 0.3 * a * cos(k * X[2]);
}

static inline void manufactured_stress(const material *m, const double X[3], double P[9])
{
    double F[9], h = 1e-4;
    for (int j = 0; j < 3; j++) {
        double up[3], down[3], x[3];
        vec_copy(X, x);
        x[j] = X[j] + h;
        manufactured_u(x, up);
        x[j] = X[j] - h;
        manufactured_u(x, down);
        for (int i = 0; i < 3; i++) F[3 * i + j] = (i == j) + (up[i] - down[i]) / (2 * h);
    }
    material_stress(m, F, P);
}

/* -Div P, mN/mm3 */
static inline void manufactured_force(const material *m, const double X[3], double b[3])
{
    double h = 1e-3, up[9], down[9], x[3];
    b[0] = b[1] = b[2] = 0;
    for (int j = 0; j < 3; j++) {
        vec_copy(X, x);
        x[j] = X[j] + h;
        manufactured_stress(m, x, up);
        x[j] = X[j] - h;
        manufactured_stress(m, x, down);
        for (int i = 0; i < 3; i++) b[i] -= (up[3 * i + j] - down[3 * i + j]) / (2 * h);
    }
}

/* Four points of degree 2: point q has the weight `far` at corner q and `near` at the others. */
static inline void quadrature_point(const tetmesh *m, int32_t t, int q, double N[4], double X[3])
{
    static const double far = 0.585410196624968, near = 0.138196601125011;
    X[0] = X[1] = X[2] = 0;
    for (int k = 0; k < 4; k++) {
        N[k] = k == q ? far : near;
        vec_axpy(X, N[k], m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + k], X);
    }
}

/* Error of the displacement in L2 over the root of the volume, mm. cells: along an edge of the cube. */
static inline double manufactured_error(int cells, double poisson, bool average, int *iterations)
{
    err e = {0};
    block b = {cells, cells, cells, {MANUFACTURED_MM, MANUFACTURED_MM, MANUFACTURED_MM}, 6, 0};
    tetmesh m = block_mesh(&b);
    attach_map a = attach_map_new(m.vertex_count, 0);
    size_t n = 3 * (size_t)m.vertex_count;
    double *x = NEW_ARRAY(double, n), *load = NEW_ARRAY(double, n), *f = NEW_ARRAY(double, n);
    region_material table = {REGION_ANY, {0}};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, poisson, &table.material, &e));
    for (int32_t v = 0; v < m.vertex_count; v++) {
        double *X = m.xyz + 3 * (size_t)v, u[3];
        bool outside = false;
        for (int c = 0; c < 3; c++) outside = outside || X[c] == 0 || X[c] == MANUFACTURED_MM;
        if (outside) tie(&a, v, SEGMENT_CRANIUM);
        manufactured_u(X, u);
        vec_add(X, u, x + 3 * (size_t)v); /* where it ought to be: the boundary, and the first guess inside */
    }
    equilibrium_problem p = {
        .mesh = &m, .attach = &a, .materials = &table, .material_count = 1, .average_volume = average};
    solver *t = NULL;
    assert_ok(solver_create(&p, 1, &t, &e));
    assert_ok(solver_order(t, &e));
    for (int32_t i = 0; i < m.tet_count; i++)
        for (int q = 0; q < 4; q++) {
            double N[4], X[3], force[3];
            quadrature_point(&m, i, q, N, X);
            manufactured_force(&table.material, X, force);
            for (int k = 0; k < 4; k++) {
                double *to = load + 3 * (size_t)m.tet[4 * (size_t)i + k];
                vec_axpy(to, N[k] * t->a.el.volume[i] / 4, force, to);
            }
        }
    memcpy(t->b.origin, x, n * sizeof *x); /* unknowns are what is added to the guess */
    double *z = NEW_ARRAY(double, t->b.unknown_count), *g = NEW_ARRAY(double, t->b.unknown_count);
    double first = 0, now = 0;
    for (*iterations = 0; *iterations < 20; ++*iterations) {
        bool positive;
        boundary_place(&t->b, z, x);
        assembly_energy(&t->a, x, f);
        for (size_t i = 0; i < n; i++) f[i] -= load[i];
        boundary_reduce(&t->b, f, g);
        now = 0;
        for (int32_t i = 0; i < t->b.unknown_count; i++) now += g[i] * g[i];
        if (*iterations == 0) first = now;
        if (now <= 1e-20 * first) break;
        assembly_stiffness(&t->a, x, PROJECTION_NONE);
        assembly_matrix(&t->a, &t->b);
        assert_ok(linear_factor(t->l, t->a.value, 0, &positive, &e));
        assert_true(positive);
        assert_ok(linear_solve(t->l, g, g, &e));
        for (int32_t i = 0; i < t->b.unknown_count; i++) z[i] -= g[i];
    }
    assert_true(now <= 1e-20 * first);
    double square = 0, volume = 0;
    for (int32_t i = 0; i < m.tet_count; i++)
        for (int q = 0; q < 4; q++) {
            double N[4], X[3], u[3], w[3];
            quadrature_point(&m, i, q, N, X);
            manufactured_u(X, u);
            vec_add(X, u, w);
            for (int k = 0; k < 4; k++) vec_axpy(w, -N[k], x + 3 * (size_t)m.tet[4 * (size_t)i + k], w);
            square += t->a.el.volume[i] / 4 * vec_dot(w, w);
            volume += t->a.el.volume[i] / 4;
        }
    free(x);
    free(load);
    free(f);
    free(z);
    free(g);
    solver_destroy(&t);
    tetmesh_free(&m);
    attach_map_free(&a);
    return sqrt(square / volume);
}
