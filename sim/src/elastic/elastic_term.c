#include "sim/src/elastic/elastic_term.h"
#include <assert.h>

static double energy(void *self, const double *x, double *force) { return assembly_energy(self, x, force); }

static void stiffness(void *self, const double *x, const double *force, projection how, assembly *a)
{
    (void)force;
    assert(self == a);
    assembly_stiffness(a, x, how);
}

term elastic_term(assembly *a) { return (term){.self = a, .energy = energy, .stiffness = stiffness}; }
