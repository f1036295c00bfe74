/* element: linear tetrahedra. x_e are four node positions, force is the derivative of the energy (mN), so
 * that equilibrium means zero and a bone pulling the tissue shows the force it needs. */
#pragma once
#include "geometry/tetmesh.h"
#include "sim/material.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct elements {
    int32_t count;
    double *gradient;  /* [12*count] shape function gradients at rest, 1/mm */
    double *volume;    /* [count] mm3 at rest */
    int32_t *material; /* [count] number in `materials` */
    int32_t material_count;
    struct material *materials;
} elements;

/* Refuses (ERR_GEOMETRY) what tetmesh_check refuses and (ERR_INPUT) a region without a material or with two. */
bool elements_make(const tetmesh *m, const region_material *table, int32_t table_count, elements *out,
                   err *e) MUST_CHECK;
void elements_free(elements *el);

/* What the volume change of a material is taken from: J of each tet, or its mean around each node where that
 * is worth its price (see average.h). */
typedef enum element_kind {
    ELEMENT_AUTO, /* averaged from nu = element_average_from on */
    ELEMENT_LINEAR,
    ELEMENT_AVERAGED /* above nu = element_keeps */
} element_kind;
extern const double element_average_from;
/* The part of lambda that makes a material with this nu is never averaged: linear tets bear it, and without
 * it single tets turn inside out in a mesh of a head. */
extern const double element_keeps;
/* Sets averaged_kpa; 0 means linear. Models other than snhlog and snh are linear in AUTO, and AVERAGED is
 * refused (ERR_INPUT). */
bool element_choose(material *m, element_kind kind, err *e) MUST_CHECK;

/* The ten node pairs of a tet that carry stiffness, i <= j. */
enum { ELEMENT_PAIRS = 10 };
extern const int element_pair[ELEMENT_PAIRS][2];

void element_gradient_F(const double gradient[12], const double x_e[12], double F[9]);
/* Energy in uJ; force[12] (may be NULL) in mN. Returns HUGE_VAL, force zero, where the material has no
 * energy. */
double element_energy(const material *m, const double gradient[12], double volume, const double x_e[12], double *force);
/* Stiffness blocks, block[9*p] = d force_i / d x_j for pair p = (i, j), row-major, mN/mm. */
void element_stiffness(const material *m, const double gradient[12], double volume, const double x_e[12],
                       projection how, double block[9 * ELEMENT_PAIRS]);

#ifdef __cplusplus
}
#endif
