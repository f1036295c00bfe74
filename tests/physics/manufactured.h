/* manufactured: a body whose exact large deformation is known, because the forces in it are chosen so (method
 * of manufactured solutions): u(X) on the cube of 10 mm, its whole surface prescribed. */
#pragma once
#include "tests/physics/loaded.h"
#include <string.h>

enum { MANUFACTURED_MM = 10 };

static inline void manufactured_u(const double X[3], double u[3])
{
    double k = 3.14159265358979 / (2 * MANUFACTURED_MM), a = 1;
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

enum { QUADRATURE = 14 };

/* Degree 5: Walkington, Quadrature on simplices of arbitrary dimension, 2000. N: barycentric coordinates of
 * point q in tet t; returns the weight, of 1 in all. */
static inline double quadrature_point(const tetmesh *m, int32_t t, int q, double N[4], double X[3])
{
    static const double near[2] = {0.31088591926330060980, 0.09273525031089122640}, edge = 0.45449629587435035051,
                        weight[3] = {0.11268792571801585080, 0.07349304311636194955, 0.04254602077708146643};
    static const int pair[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    for (int k = 0; k < 4; k++) {
        if (q < 8)
            N[k] = q % 4 == k ? 1 - 3 * near[q / 4] : near[q / 4];
        else
            N[k] = pair[q - 8][0] == k || pair[q - 8][1] == k ? 0.5 - edge : edge;
    }
    X[0] = X[1] = X[2] = 0;
    for (int k = 0; k < 4; k++) vec_axpy(X, N[k], m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)k], X);
    return weight[q / 4 < 2 ? q / 4 : 2];
}

/* Error of the displacement in L2 over the root of the volume, mm. cells: along an edge of the cube. */
static inline double manufactured_error(int cells, double poisson, element_kind kind, int *iterations)
{
    err e = {0};
    block b = {cells, cells, cells, {MANUFACTURED_MM, MANUFACTURED_MM, MANUFACTURED_MM}, 6, 0};
    tetmesh m = block_mesh(&b);
    attach_map a = attach_map_new(m.vertex_count, 0);
    size_t n = 3 * (size_t)m.vertex_count;
    double *x = NEW_ARRAY(double, n), *load = NEW_ARRAY(double, n);
    region_material table = {REGION_ANY, {0}};
    assert_ok(material_make(MATERIAL_SNH_LOG, 15, poisson, &table.material, &e));
    assert_ok(element_choose(&table.material, kind, &e));
    for (int32_t v = 0; v < m.vertex_count; v++) {
        double *X = m.xyz + 3 * (size_t)v, u[3];
        bool outside = false;
        for (int c = 0; c < 3; c++) outside = outside || X[c] == 0 || X[c] == MANUFACTURED_MM;
        if (outside) tie(&a, v, SEGMENT_CRANIUM);
        manufactured_u(X, u);
        vec_add(X, u, x + 3 * (size_t)v); /* where it ought to be: the boundary, and the first guess inside */
    }
    equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
    solver *t = NULL;
    assert_ok(solver_create(&p, 1, &t, &e));
    for (int32_t i = 0; i < m.tet_count; i++)
        for (int q = 0; q < QUADRATURE; q++) {
            double N[4], X[3], force[3], weight = t->a.el.volume[i] * quadrature_point(&m, i, q, N, X);
            manufactured_force(&table.material, X, force);
            for (int k = 0; k < 4; k++) {
                double *to = load + 3 * (size_t)m.tet[4 * (size_t)i + k];
                vec_axpy(to, N[k] * weight, force, to);
            }
        }
    memcpy(t->b.origin, x, n * sizeof *x); /* unknowns are what is added to the guess */
    *iterations = loaded_solve(t, load, 1, x);
    double square = 0, volume = 0;
    for (int32_t i = 0; i < m.tet_count; i++)
        for (int q = 0; q < QUADRATURE; q++) {
            double N[4], X[3], u[3], w[3], weight = t->a.el.volume[i] * quadrature_point(&m, i, q, N, X);
            manufactured_u(X, u);
            vec_add(X, u, w);
            for (int k = 0; k < 4; k++) vec_axpy(w, -N[k], x + 3 * (size_t)m.tet[4 * (size_t)i + k], w);
            square += weight * vec_dot(w, w);
            volume += weight;
        }
    free(x);
    free(load);
    solver_destroy(&t);
    tetmesh_free(&m);
    attach_map_free(&a);
    return sqrt(square / volume);
}
