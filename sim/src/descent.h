/* descent: the iteration at one load. */
#pragma once
#include "sim/linear.h"
#include "sim/newton.h"
#include "sim/src/contact_state.h"

enum { PAIR_LIMIT = 16 }; /* steps remembered between factorisations */

struct solver {
    const tetmesh *mesh;
    const attach_map *attach; /* the caller's, or with contact `loosened` */
    attach_map loosened;
    contact *touch; /* NULL: no contact */
    boundary b;
    assembly a;
    linear *l; /* NULL where nothing is unknown */
    double prepare_s;
};

typedef struct descent {
    solver *t;
    const solve_params *params;
    equilibrium *out; /* records and counts go here */
    double load;
    /* present iterate */
    double *z, *x, *force, *g;
    double energy, residual, tolerance, energy_noise;
    /* trial point, direction, work */
    double *z_new, *x_new, *force_new, *g_new, *direction;
    /* L-BFGS memory, newest last; q and alpha are work */
    double *pair_s[PAIR_LIMIT], *pair_y[PAIR_LIMIT], pair_rho[PAIR_LIMIT];
    int pair_count;
    bool touching;   /* contact counts now */
    double blend;    /* part of the clamped matrix that the last blend needed */
    bool has_factor; /* of this load's matrix, true, blended or projected */
    int since_factor;
    double residual_at_factor;
} descent;

void descent_make(descent *d, solver *t, const solve_params *params, equilibrium *out);
void descent_free(descent *d);
/* Equilibrium at the boundary's present place, from x_start[3*nodes] (all nodes, prescribed ones where they
 * were). free_first: with contact, phase A comes before. False: refused. *outcome is never SOLVED unless the
 * residual is below the tolerance; d->x is the last iterate. */
bool descent_run(descent *d, double load, double rel_tol, bool free_first, const double *x_start,
                 solve_outcome *outcome, err *e) MUST_CHECK;
