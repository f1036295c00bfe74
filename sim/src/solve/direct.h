/* direct: directions by factorised matrices, and the matrix at hand. */
#pragma once
#include "sim/equilibrium.h"

struct descent;

enum { PAIR_LIMIT = 16 }; /* steps remembered between factorisations */

/* How the last matrix of a load became positive definite. */
typedef enum blend_need {
    BLEND_NONE,  /* it was the true one; or none was made yet */
    BLEND_FIRST, /* with the first part of the clamped one that was tried */
    BLEND_LADDER /* it took several */
} blend_need;

typedef struct direct_state {
    bool has_factor; /* of this load's matrix, true, blended or projected */
    blend_need need; /* of the last factor of this load */
    double blend;    /* part of the clamped matrix that the last blend needed, at whatever load and by whichever way */
    int since_factor;
    double residual_at_factor;
    /* L-BFGS memory, newest last */
    double *pair_s[PAIR_LIMIT], *pair_y[PAIR_LIMIT], pair_rho[PAIR_LIMIT];
    int pair_count;
} direct_state;

direct_state direct_begin(void);
void direct_free(direct_state *m);
/* For a new load. */
void direct_begin_load(direct_state *m);
/* The next step needs a new factor: the energy has changed. */
void direct_forget(direct_state *m);
/* The factor at hand is of a place near by: it will do for the first steps. */
void direct_adopt(direct_state *m, double residual);
/* The rate at which steps pay is counted from this residual, mN. */
void direct_measure_from(direct_state *m, double residual);
/* The first contacts of a load are deep: the clamped matrix is where to begin. */
void direct_expect_deep(direct_state *m);
/* The part of the clamped matrix with which a ladder of blends begins; each rung is twice the one before, four times
 * under contact. */
double direct_first_rung(const direct_state *m);
/* Fills the assembly's matrix at x, with contact where it counts. */
void direct_fill(struct descent *d, const double *x, projection how);
/* Factorises at x, from the wanted kind on towards the safer ones. *kind says what it became; *ok false: none. Adds to
 * *seconds. */
bool direct_factorise(struct descent *d, const double *x, hessian_kind *kind, bool *ok, double *seconds,
                      err *e) MUST_CHECK;
/* direction = -(inverse Hessian) g by the factor and the steps since. */
bool direct_direction(struct descent *d, err *e) MUST_CHECK;
/* After point_accept: the old point is the trial one. */
void direct_remember(struct descent *d);
/* Is another step with the old factor the cheaper way? */
bool direct_reusable(const struct descent *d);
