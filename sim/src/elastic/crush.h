/* crush: tets that are not to be turned inside out.
 *
 * The Stable Neo-Hookean energies resist inversion by a finite force, which a corner of a bone or a tooth can bring up
 * on a small tet. One that a solve leaves with less than least_j of its volume is guarded: a pressure p s(u) acts in it
 * where u = 1 - J / (2 least_j) > 0, s = u^2 up to u = 1, where it has no volume, then 1 + 2 ln u, so that one that is
 * far inside out does not tear its neighbours; p is raised until J is at least least_j. The rest of the tissue never
 * pays. */
#pragma once
#include "sim/src/energy/term.h"

typedef struct crushed_tet {
    int32_t tet;
    double pressure_kpa; /* on the tet when it has no volume */
} crushed_tet;

typedef struct crush {
    assembly *a; /* borrowed */
    double least_j;
    int32_t count;
    crushed_tet *tet; /* [count] */
} crush;

void crush_free(crush *c);
/* None is guarded; from here on none is to have less than least_j, in [0, 0.5]; 0: none ever
 * is. */
void crush_begin(crush *c, double least_j);
/* Guards every tet that has less than least_j at x[3*nodes]; again: those that are guarded too, four times as stiffly
 * as before. Where all of its nodes are fixed, which fixed[nodes] says, there is no help. False: there is none. */
bool crush_stiffen(crush *c, const uint8_t *fixed, bool again, const double *x);
term crush_term(crush *c);
