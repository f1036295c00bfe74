/* solver_state: what a solver keeps from plan to plan. */
#pragma once
#include "sim/linear.h"
#include "sim/solver.h"
#include "sim/src/actuation/target_term.h"
#include "sim/src/contact/contact_state.h"
#include "sim/src/elastic/crush.h"
#include "sim/src/energy/term.h"
#include "sim/src/linear/multigrid.h"
#include "sim/src/linear/node_blocks.h"

struct solver {
    const tetmesh *mesh;
    const attach_map *attach; /* the caller's, or with contact that is not held `loosened` */
    attach_map loosened;
    contact *touch;    /* NULL: no contact */
    target_pull *pull; /* NULL: no targets */
    boundary b;
    assembly a;
    crush crushed;
    term_list terms;
    int blas_threads;
    linear *l; /* NULL until a matrix is to be factorised */
    /* for conjugate gradients; NULL until then */
    node_blocks f;
    blocks k;
    multigrid *grid;
    double grid_rate; /* iterations per digit with the matrix it was made of; 0: not known yet */
    double grid_loss; /* iterations lost since, for its age */
    double *matrix_x; /* [3*nodes] where the assembly's node blocks are those without contact, else NULL */
    double prepare_s;
    bool goes_on; /* from the last plan, with its contacts */
    bool
        factor_kept; /* l holds a factor of the true matrix, and the assembly its node blocks, near the last solution */
    bool factor_used; /* and the next first guess is made with it */
};

/* Puts the bones in place, for boundary and contacts. */
void solver_place(solver *t, const rigid motion[SEGMENT_COUNT]);

/* Makes t->l where it is not there. Refuses what linear_create refuses. */
bool solver_order(solver *t, err *e) MUST_CHECK;
/* The node blocks become others: matrix_x no longer holds. */
void solver_forget_blocks(solver *t);
