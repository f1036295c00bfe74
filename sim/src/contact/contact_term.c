#include "sim/src/contact/contact_term.h"

static double energy(void *self, const double *x, double *force) { return contact_energy(self, x, force); }

static void stiffness(void *self, const double *x, const double *force, projection how, assembly *a)
{
    contact_stiffness(self, x, force, how == PROJECTION_NONE, a);
}

term contact_term(contact *c)
{
    return (term){.self = c, .is_a_contact = true, .energy = energy, .stiffness = stiffness};
}
