/* average: nodal averaging of the volume change (Bonet & Burton 1998), against the locking of linear tets
 * near incompressibility. What `averaged_kpa` says of a material's lambda does not ask  (J - 1)^2 / 2  of
 * each tet, but  sum_p V_p (J_p - 1)^2 / 2  of its patches: patch p is the tets of the material around one
 * node, V_p a quarter of their volume and J_p their mean J, so that a node between two materials has a patch
 * of each. An energy, hence with a symmetric stiffness; it couples nodes of neighbouring tets. */
#pragma once
#include "sim/element.h"

typedef struct averages {
    int32_t tet_count, patch_count;
    const int32_t *tet;         /* borrowed */
    int32_t *patch;             /* [4*tets] of each corner of a tet, -1: its material is not averaged */
    int32_t *start, *source;    /* the corners of each patch: source = 4 tet + local node */
    double *volume, *kpa;       /* [patches] V_p in mm3, modulus */
    double *change, *pressure;  /* [tets] V/4 (J - 1); [patches] kPa */
    int32_t *ring_start, *ring; /* nodes of each patch's tets, ascending */
    double *slope;              /* [3*ring] of sqrt(kpa / V_p) V_p J_p with their positions */
    int64_t pair_count;
    int32_t *pair; /* [2*pairs] places in `ring` that the stiffness couples, low <= high */
} averages;

/* NULL where no material is averaged. The caller frees. */
averages *average_make(const tetmesh *m, const elements *el);
void average_free(averages *g);

/* Mean volume changes and pressures at x. Returns their energy, uJ. */
double average_update(averages *g, const elements *el, const double *x);
/* The material of a tet under the mean pressure of its patches: its forces and stiffness are those of the
 * whole energy, but for the pairs; its energies sum to that of average_update too much. */
material average_material(const averages *g, const elements *el, int64_t t);
/* Slopes at x. */
void average_slopes(averages *g, const elements *el, const double *x);
/* Adds the stiffness of a pair between its low and its high node. */
void average_add(const averages *g, int64_t pair, double block[9]);
