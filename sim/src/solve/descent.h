/* descent: what the loads of one solve work with. load.c takes a load through its phases, start.c makes the first
 * guess, iterate.c the iteration, step.c chooses the way of each step: direct.c by factorised matrices, inexact.c by
 * conjugate gradients; point.c holds the iterates and the line search. */
#pragma once
#include "sim/src/solve/direct.h"
#include "sim/src/solve/load.h"
#include "sim/src/solve/solver_state.h"

/* A place of the tissue and what the energy does there. */
typedef struct point {
    double *z, *x;     /* unknowns; [3*nodes] mm */
    double *force, *g; /* [3*nodes] mN; of each unknown */
} point;

typedef struct descent {
    solver *t;
    const solve_params *params;
    equilibrium *out;          /* records and counts go here */
    int factorisations_before; /* of the solver, when this solve began */
    point here, trial;
    double energy, residual; /* of the present iterate, here: uJ; norm of g, mN */
    double *direction;       /* [unknowns] */
    direct_state direct;
    load_state load;
} descent;

/* No other load, and no other phase of this one, can mend it. */
static inline bool outcome_is_final(solve_outcome outcome)
{
    return outcome == STOPPED_INTERRUPTED || outcome == STOPPED_MAX_WORK;
}

void descent_make(descent *d, solver *t, const solve_params *params, equilibrium *out);
void descent_free(descent *d);

/* load.c */
/* Equilibrium at the boundary's present place, from x_start[3*nodes] (all nodes, prescribed ones where they were).
 * False: refused. *outcome is never SOLVED unless the residual is below the tolerance; d->here is the last iterate.
 * Where flat tets make the first residual huge, a part of it says little: so at load 1 the last step must be small as
 * well, below sqrt(rel_tol) of the bones' move against the tissue. A Newton step converges quadratically, so that this
 * asks for nothing more where the residual is a good measure. */
bool load_run(descent *d, const load_task *task, const double *x_start, solve_outcome *outcome, err *e) MUST_CHECK;

/* start.c */
/* Residual of the reference: prescribed nodes moved, free ones carried by the guide only, nothing touches. It sees no
 * common rigid motion, so a turned head is held to the same tolerance. */
double start_reference(descent *d);
/* How far bones move from where the guide would carry them, or targets draw the tissue at rest, mm. */
double start_bones_move(const solver *t);
/* Adds to z the linear response, about x_start, to carrying the prescribed nodes from x_start to here. *ok false: the
 * start or its end has no energy. */
bool start_guess(descent *d, const double *x_start, double *seconds, int *cg_iterations, bool *ok, err *e) MUST_CHECK;

/* iterate.c */
/* Renews what contact sees of the present iterate, and lays the planes of sliding nodes anew. */
void iterate_refresh(descent *d);
/* Steps until the residual is low. The outcome of the iteration is not yet that of the load. */
bool iterate(descent *d, int max_iterations, solve_outcome *outcome, err *e) MUST_CHECK;

/* step.c */
typedef struct step_taken {
    double length; /* fraction of the direction; 0: no step is good */
    hessian_kind kind;
    int cg_iterations;
    double factor_s;
} step_taken;

/* The way in which a load begins. */
step_way step_first_way(const descent *d);
/* Contact counts from now on. */
void step_expect_contact(descent *d);
/* *ok false: there is no matrix to step with. */
bool step_take(descent *d, step_taken *s, bool *ok, err *e) MUST_CHECK;

/* point.c */
double point_dot(const double *a, const double *b, int64_t n);
/* The force that rounding alone makes at x[3*nodes], mN. */
double point_force_noise(const solver *t, const double *x);
/* Energy at x, with contact where it is to count; fills p->force and p->g. */
double point_evaluate(descent *d, bool touching, const double *x, point *p);
/* The trial point becomes the present one, which becomes the trial point. */
void point_accept(descent *d, double energy);
/* Energy, force and residual of the present iterate, as after a change of what counts. */
void point_measure(descent *d);
/* Contacts at p, which is where they were last evaluated, that are deeper than was foreseen give way; then its x and z
 * are where they get to. Returns the farthest move, mm; see contact_yield. */
double point_yield(descent *d, point *p);
/* Step length along direction, 0 where none is good; then the accepted point is the present one. */
double point_line_search(descent *d);

/* inexact.c */
/* Makes the matrix at x ready for inexact_solve; kind TRUE or PROJECTED. near_enough: one of a place within
 * 0.01 mm will do. *ok false: it has no preconditioner. Adds to *seconds. */
bool inexact_matrix(descent *d, const double *x, hessian_kind kind, bool near_enough, bool *ok, double *seconds,
                    err *e) MUST_CHECK;
/* u = about its inverse times b, the residual rel_tol of b. Where the matrix shows negative curvature u is
 * where the iteration had got to: u.b > 0 still. *ok false: the iteration got nowhere. */
bool inexact_solve(descent *d, const double *b, double rel_tol, double *u, int *cg_iterations, bool *ok,
                   err *e) MUST_CHECK;
/* direction = about -(inverse Hessian) g, as exact as is worth it so far from the solution; s->kind in and out. */
bool inexact_direction(descent *d, step_taken *s, bool *ok, err *e) MUST_CHECK;

/* result.c */
/* Adds the present iterate to the records and tells the caller. */
void result_record(descent *d, int iteration, const step_taken *s);
/* What is told of the last iterate; before: the solver's counts at the beginning. */
void result_fill(descent *d, solve_outcome outcome, const linear_stats *before);
