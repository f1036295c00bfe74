/* target_term: the springs of `targets` as a summand of the energy. Which node and which pair of nodes a point bears on
 * is sorted once; places, normals and stiffnesses may change between solves. */
#pragma once
#include "sim/src/energy/term.h"
#include "sim/targets.h"

typedef struct target_pull target_pull;

/* Borrows all three. a: pattern of the tissue that the points lie in. */
target_pull *target_pull_make(const targets *t, const tetmesh *m, const assembly *a);
void target_pull_free(target_pull **p); /* idempotent */
term target_term(target_pull *p);
/* The longest way that any point is from where it is drawn to, at x[3*nodes], mm. */
double target_pull_longest(const target_pull *p, const double *x);
/* The force that rounding alone makes, norm over all nodes; the same of the energy, uJ. */
double target_pull_force_noise(const target_pull *p, const double *x);
double target_pull_energy_noise(const target_pull *p, const double *x);
