/* average: nodal averaging of the volume change (Bonet & Burton 1998), against the locking of linear tets
 * near incompressibility. lambda/2 (J - 1)^2 of each tet becomes  sum_a V_a lambda/2 (J_a - 1)^2  with V_a a
 * quarter of the tets around node a and J_a their mean J. An energy, so the stiffness stays symmetric; it
 * couples nodes of neighbouring tets. */
#pragma once
#include "sim/assemble.h"

/* Pairs of nodes (low < high, each once per common neighbour) that the stiffness couples. Caller frees. */
int32_t average_couplings(const tetmesh *m, int32_t **pairs);
/* After assembly_make with these couplings. Refuses (ERR_INPUT) other than one material of snhlog or snh. */
bool average_make(assembly *a, err *e) MUST_CHECK;
void average_free(assembly *a);

/* Mean volume changes and pressures at x; returns the energy. */
double average_energy(assembly *a, const double *x);
/* The material of a tet under the mean pressure of its nodes: its forces and stiffness are those of the whole
 * energy, but for average_stiffness; its energy holds volume * pressure * (J - 1) too much. */
material average_material(const assembly *a, int64_t t);
/* Adds what couples the volume changes to edge_block, from the pressures of the last average_energy. */
void average_stiffness(assembly *a, const double *x);
