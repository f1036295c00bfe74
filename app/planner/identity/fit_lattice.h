/* fit_lattice: surfaces drawn onto others by a lattice around them, which carries what else lies there. */
#pragma once
#include "geometry/lattice.h"
#include "sim/registration.h"

enum { FIT_LATTICE_PARTS = 5 };

typedef struct fit_lattice {
    double edge_mm, margin_mm;
    registration_params how;
    int part_count;
    surface *moved[FIT_LATTICE_PARTS];               /* where they are now; their vertices move */
    const target_surface *target[FIT_LATTICE_PARTS]; /* NULL: only carried */
    double weight[FIT_LATTICE_PARTS];
    const uint8_t *mute[FIT_LATTICE_PARTS]; /* [vertices] 1: only carried; NULL: none is */
    const double *fixed; /* [3*vertices] places of part 0's vertices that are known, NAN: not known; or NULL */
    double *points;      /* [3*point_count] points that are carried too, or NULL */
    int32_t point_count;
} fit_lattice;

/* What registrations cost and came to, summed over several. */
typedef struct fit_cost {
    int rounds, iterations, factorisations;
    double min_j; /* of the lattices */
} fit_cost;

/* Refuses what lattice_cover and registration_run refuse. */
bool fit_lattice_draw(const fit_lattice *f, fit_cost *cost, err *e) MUST_CHECK;
