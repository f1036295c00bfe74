/* load: one load, from its start to its equilibrium, in phases.
 *
 *              the start is the answer
 *    START -----------------------------------> WHOLE ---> ENDED
 *      |  it is near an equilibrium with contact  ^
 *      +----------------------------------> NEAR -+
 *      |  else                                    |
 *      +----------------------------------> FREE -+
 *
 * START  all that is to count at this load counts: is the residual low as it is?
 * FREE   contact does not count: a first guess, and phase A where the task asks for it
 * NEAR   a first guess with contact
 * WHOLE  all that is to count counts. Before each step contact is looked at anew: colliders are renewed, what is too
 *        deep is stiffened, what went through a bone is brought back by a guard (iterate.c).
 * ENDED  with an outcome: of WHOLE, or at once from any phase where there is no energy or an interruption. */
#pragma once
#include "sim/equilibrium.h"

typedef enum load_phase { LOAD_START, LOAD_FREE, LOAD_NEAR, LOAD_WHOLE, LOAD_ENDED } load_phase;

/* What is asked of a load. */
typedef struct load_task {
    double load; /* 0..1 */
    double rel_tol;
    bool touches;    /* contact counts in the end */
    bool near;       /* the start is near an equilibrium with contact, which counts all along */
    bool free_first; /* phase A comes before contact */
} load_task;

/* How steps are found; conjugate gradients may give way to factors within a load, not the other way. */
typedef enum step_way { BY_GRADIENTS, BY_FACTORS } step_way;

typedef struct load_state {
    load_task task;
    load_phase phase;
    bool at_rest; /* the start was the answer */
    bool over;    /* the load ends, with: */
    solve_outcome outcome;
    step_way way;
    double asked_mn;        /* of the residual; */
    double tolerance_mn;    /* this, or what contact leaves */
    double settled_mm;      /* a last step below so much is small */
    double energy_noise_uj; /* of rounding, at the first iterate */
    double last_step_mm;    /* longest move of an unknown in the last step; 0 before the first */
    double residual_before; /* mN, of the iterate before; 0 at the first */
    bool was_cut;           /* the last step by gradients took a part of its direction only, or nothing */
    int64_t cg_iterations;
} load_state;

/* The one transition. */
load_phase load_phase_after(const load_state *l);
/* Does contact count now? */
static inline bool load_touching(const load_state *l) { return l->task.touches && l->phase != LOAD_FREE; }
