/* descent: the iteration at one load. descent.c drives; point.c holds iterates and the line search, start.c
 * the first guess, direct.c directions by factorised matrices, inexact.c those by conjugate gradients. */
#pragma once
#include "sim/linear.h"
#include "sim/solver.h"
#include "sim/src/contact/contact_state.h"
#include "sim/src/linear/node_blocks.h"
#include "sim/src/linear/multigrid.h"

enum { PAIR_LIMIT = 16 }; /* steps remembered between factorisations */

struct solver {
    const tetmesh *mesh;
    const attach_map *attach; /* the caller's, or with contact `loosened` */
    attach_map loosened;
    contact *touch; /* NULL: no contact */
    boundary b;
    assembly a;
    int blas_threads;
    linear *l; /* NULL until a matrix is to be factorised */
    /* for conjugate gradients; NULL until then */
    node_blocks f;
    blocks k;
    multigrid *grid;
    double grid_rate; /* iterations per digit with the matrix it was made of; 0: not known yet */
    double grid_loss; /* iterations lost since, for its age */
    double *matrix_x; /* [3*nodes] where the assembly's node blocks are those of the elastic energy, else NULL */
    double prepare_s;
};

/* Makes t->l where it is not there. */
bool solver_order(solver *t, err *e) MUST_CHECK;

typedef struct descent {
    solver *t;
    const solve_params *params;
    equilibrium *out; /* records and counts go here */
    bool inexact;     /* conjugate gradients, else factorised matrices */
    double load;
    /* present iterate */
    double *z, *x, *force, *g;
    double energy, residual, tolerance, rel_tol, energy_noise;
    double asked;           /* of the residual; tolerance is this, or what contact leaves */
    double settled;         /* a last step below so much, mm, is small; see descent_run */
    double last_step;       /* longest move of an unknown in the last step, mm; 0: none yet */
    double residual_before; /* of the last iterate */
    /* trial point, direction, work */
    double *z_new, *x_new, *force_new, *g_new, *direction;
    /* L-BFGS memory, newest last */
    double *pair_s[PAIR_LIMIT], *pair_y[PAIR_LIMIT], pair_rho[PAIR_LIMIT];
    int pair_count;
    bool touching;         /* contact counts now */
    bool touch_on_the_way; /* held contact counts at all loads, not at the last one only */
    bool cut;              /* the last step was */
    bool warm;             /* this load began near an equilibrium with contact */
    int64_t cg_at_load;
    double blend;    /* part of the clamped matrix that the last blend needed */
    int blend_tries; /* until the last factor of this load; 0: it is one of the true matrix */
    bool has_factor; /* of this load's matrix, true, blended or projected */
    int since_factor;
    double residual_at_factor;
} descent;

void descent_make(descent *d, solver *t, const solve_params *params, equilibrium *out);
void descent_free(descent *d);
/* Equilibrium at the boundary's present place, from x_start[3*nodes] (all nodes, prescribed ones where they
 * were). free_first: with contact, phase A comes before. warm: x_start is near an equilibrium with contact,
 * which counts from the first guess on. False: refused. *outcome is never SOLVED unless the residual is below
 * the tolerance; d->x is the last iterate. Where flat tets make the first residual huge, a part of it says
 * little: so at load 1 the last step must be small as well, below sqrt(rel_tol) of the bones' move against
 * the tissue. A Newton step converges quadratically, so that this asks for nothing more where the residual is
 * a good measure. */
bool descent_run(descent *d, double load, double rel_tol, bool free_first, bool warm, const double *x_start,
                 solve_outcome *outcome, err *e) MUST_CHECK;

/* point.c */
double point_dot(const double *a, const double *b, int64_t n);
/* Energy at x with contact where it counts; fills force[3*nodes] and g[unknowns]. */
double point_evaluate(descent *d, const double *x, double *force, double *g);
/* The trial point becomes the present one, which becomes the trial point. */
void point_accept(descent *d, double energy);
/* Energy, force and residual of the present iterate, as after a change of what counts. */
void point_measure(descent *d);
/* Adds the present iterate to the records and tells the caller. */
void point_record(descent *d, int iteration, double step, hessian_kind kind, double factor_s, int cg_iterations);
/* Contacts at x, z that are deeper than was foreseen give way; then both are where they get to. Returns the
 * farthest move, mm; see contact_yield. */
double point_yield(descent *d, double *x, double *z);
/* Step length along direction, 0 where none is good; then the accepted point is the present one. */
double point_line_search(descent *d);

/* start.c */
/* Residual of the reference: prescribed nodes moved, free ones carried by the guide only. It sees no common
 * rigid motion, so a turned head is held to the same tolerance. */
double start_reference(descent *d);
/* Adds to z the linear response, about x_start, to carrying the prescribed nodes from x_start to x. *ok
 * false: the start or its end has no energy. */
bool start_predict(descent *d, const double *x_start, double *seconds, int *cg_iterations, bool *ok, err *e) MUST_CHECK;

/* direct.c */
/* The part of the clamped matrix with which a ladder of blends begins; each rung is twice the one before,
 * four times under contact. */
double direct_first_rung(const descent *d);
/* Fills the assembly's matrix at x, with contact where it counts. */
void direct_fill(descent *d, const double *x, projection how);
/* Factorises at x, from the wanted kind on towards the safer ones. *kind says what it became; *ok false:
 * none. */
bool direct_factorise(descent *d, const double *x, hessian_kind *kind, bool *ok, double *seconds, err *e) MUST_CHECK;
/* direction = -(inverse Hessian) g by the factor and the steps since. */
bool direct_direction(descent *d, err *e) MUST_CHECK;
/* After point_accept: the old point is in z_new, g_new. */
void direct_remember(descent *d);
/* Is another step with the old factor the cheaper way? */
bool direct_reusable(const descent *d);

/* inexact.c */
/* Makes the matrix at x ready for inexact_solve; kind TRUE or PROJECTED. near_enough: one of a place within
 * 0.01 mm will do. *ok false: it has no preconditioner. */
bool inexact_matrix(descent *d, const double *x, hessian_kind kind, bool near_enough, bool *ok, double *seconds,
                    err *e) MUST_CHECK;
/* u = about its inverse times b, the residual rel_tol of b. Where the matrix shows negative curvature u is
 * where the iteration had got to: u.b > 0 still. *ok false: the iteration got nowhere. */
bool inexact_solve(descent *d, const double *b, double rel_tol, double *u, int *cg_iterations, bool *ok,
                   err *e) MUST_CHECK;
/* direction = about -(inverse Hessian) g, as exact as is worth it so far from the solution. */
bool inexact_direction(descent *d, hessian_kind *kind, int *cg_iterations, bool *ok, double *seconds,
                       err *e) MUST_CHECK;
