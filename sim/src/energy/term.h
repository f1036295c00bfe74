/* term: the summands of the energy that a solve minimises.
 *
 * A term fills this table in a file of its own, and solver_create puts it on the list. Sums are taken in the order of
 * the list, which decides their last bits. The elastic energy of the tissue comes first and fills forces and node
 * blocks; each one after it adds to what is there, and sees it. Contact is the second.
 *
 * Asked for by name are still: node pairs that a term couples beyond those of the tets (assembly_make); what rounding
 * does to the forces (iterate.c); and all that contact does to the iteration beside being an energy: it renews
 * colliders, keeps sliding nodes on their levels, and gives way to a step that takes a few nodes too deep. */
#pragma once
#include "sim/assemble.h"

typedef struct term {
    void *self;        /* borrowed */
    bool is_a_contact; /* left out while contact does not count */
    /* uJ at x[3*nodes], HUGE_VAL where it has none; its derivative is added to force[3*nodes] (may be NULL), mN. */
    double (*energy)(void *self, const double *x, double *force);
    /* Its Hessian at x is added to the node blocks of a, mN/mm. Not called where the energy is infinite. how says what
     * becomes of negative curvature: with PROJECTION_NONE it stays, else what is added is positive semidefinite; CLAMP
     * and ABS may be the same to a term that drops the curvature instead. force[3*nodes]: of the whole sum at x; NULL
     * where contact does not count. */
    void (*stiffness)(void *self, const double *x, const double *force, projection how, assembly *a);
} term;

enum { TERM_MOST = 8 };

typedef struct term_list {
    int count;
    term term[TERM_MOST];
} term_list;

void term_add(term_list *l, term t);
/* The sum in uJ at x[3*nodes]; force[3*nodes] (may be NULL) is filled. Where a term has no energy the sum is HUGE_VAL,
 * and those after it are not asked. */
double term_energy(const term_list *l, bool touching, const double *x, double *force);
/* Fills the node blocks of a at x. */
void term_stiffness(const term_list *l, bool touching, const double *x, const double *force, projection how,
                    assembly *a);
