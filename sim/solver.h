/* solver: one tissue, solved for one plan after the other. What does not depend on how the bones move is made once:
 * elements, pattern and its ordering, what could touch what. */
#pragma once
#include "sim/equilibrium.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct solver solver;

/* motion and start_xyz of the problem are not looked at; mesh, attach, contact and targets are borrowed until
 * solver_destroy; places, normals and stiffnesses of the targets may change between solves. blas_threads >= 1, see
 * linear.h. The caller destroys *out. Refuses what equilibrium_solve refuses, but of the motions and parameters. */
bool solver_create(const equilibrium_problem *problem, int blas_threads, solver **out, err *e) MUST_CHECK;
void solver_destroy(solver **t);

/* As equilibrium_solve, for bones that go to motion from rest; start_xyz[3*nodes]: a guess at the result, or NULL. The
 * caller frees *out. A plan solved from rest gives the same bits whatever was solved before; one that starts at the
 * last solution starts with its matrix and preconditioner too. */
bool solver_solve(solver *t, const rigid motion[SEGMENT_COUNT], const double *start_xyz, const solve_params *params,
                  equilibrium *out, err *e) MUST_CHECK;

/* The same for bones that go on from `from`, where x[3*nodes] was the result: it starts where tissue and contacts go to
 * first order, and keeps the contacts' guards and stiffenings. Of several equilibria it is more often the one next to
 * the last plan's than that on the way from rest. */
bool solver_follow(solver *t, const rigid from[SEGMENT_COUNT], const rigid to[SEGMENT_COUNT], const double *x,
                   const solve_params *params, equilibrium *out, err *e) MUST_CHECK;
/* Takes over guards and stiffenings of the contacts that both have; the mesh is the same. */
void solver_inherit(solver *t, const solver *before);
/* Matrix and preconditioner of the last plan go: no solve from a start depends on plans before then. */
void solver_forget(solver *t);

#ifdef __cplusplus
}
#endif
