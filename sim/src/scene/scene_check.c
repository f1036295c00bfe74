#include "geometry/mem.h"
#include "sim/scene.h"
#include "sim/src/linear/conjugate.h"
#include <stdlib.h>
#include <string.h>

/* One digit of an error is enough. */
static const double rel_tol = 0.03;
static const int max_iterations = 2000;

static void apply(const double *x, double *out, void *context)
{
    const assembly *a = context;
    memset(out, 0, (size_t)a->unknown_count * sizeof *out);
    for (int64_t j = 0; j < a->unknown_count; j++) {
        double sum = a->value[a->column_start[j]] * x[j];
        for (int64_t k = a->column_start[j] + 1; k < a->column_start[j + 1]; k++) {
            sum += a->value[k] * x[a->row[k]];
            out[a->row[k]] += a->value[k] * x[j];
        }
        out[j] += sum;
    }
}

/* Forces at x on nodes that were held, as right-hand side. */
static void held_forces(assembly *a, const boundary *b, const uint8_t *held, const double *x, double *g)
{
    double *force = NEW_ARRAY(double, 3 * (size_t)a->node_count);
    assembly_energy(a, x, force);
    for (size_t i = 0; i < 3 * (size_t)a->node_count; i++) force[i] = held[i / 3] ? -force[i] : 0;
    boundary_reduce(b, force, g);
    free(force);
}

static void respond(assembly *a, boundary *b, const tetmesh *m, const uint8_t *held, const double *x, double *error)
{
    size_t n = (size_t)a->unknown_count;
    double *g = NEW_ARRAY(double, n), *z = NEW_ARRAY(double, n), *diagonal = NEW_ARRAY(double, n),
           *still = NEW_ARRAY(double, 3 * (size_t)a->node_count);
    held_forces(a, b, held, x, g);
    assembly_stiffness(a, m->xyz, PROJECTION_NONE); /* at rest it is positive definite, and near rest it is needed */
    assembly_matrix(a, b);
    for (size_t j = 0; j < n; j++) diagonal[j] = a->value[a->column_start[j]];
    conjugate_solve((int64_t)n, apply, a, diagonal, g, z, rel_tol, max_iterations);
    boundary_place(b, z, error);
    memset(z, 0, n * sizeof *z);
    boundary_place(b, z, still);
    for (size_t i = 0; i < 3 * (size_t)a->node_count; i++) error[i] -= still[i];
    free(g);
    free(z);
    free(diagonal);
    free(still);
}

bool scene_check(const equilibrium_problem *problem, const uint8_t *held, const double *x, double *error, err *e)
{
    elements el = {0};
    boundary b = {0};
    assembly a = {0};
    bool ok = elements_make(problem->mesh, problem->materials, problem->material_count, &el, e) &&
              boundary_make(problem->mesh, problem->attach, &b, e) &&
              assembly_make(problem->mesh, &el, &b, NULL, 0, &a, e);
    if (ok) {
        boundary_move(&b, problem->mesh, problem->attach, problem->motion);
        respond(&a, &b, problem->mesh, held, x, error);
    }
    assembly_free(&a);
    boundary_free(&b);
    elements_free(&el);
    return ok;
}
