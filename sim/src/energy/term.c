#include "sim/src/energy/term.h"
#include <assert.h>
#include <math.h>

void term_add(term_list *l, term t)
{
    assert(l->count < TERM_MOST);
    l->term[l->count++] = t;
}

double term_energy(const term_list *l, bool touching, const double *x, double *force)
{
    double sum = 0;
    for (int i = 0; i < l->count && isfinite(sum); i++)
        if (touching || !l->term[i].is_a_contact) sum += l->term[i].energy(l->term[i].self, x, force);
    return sum;
}

void term_stiffness(const term_list *l, bool touching, const double *x, const double *force, projection how,
                    assembly *a)
{
    for (int i = 0; i < l->count; i++)
        if (touching || !l->term[i].is_a_contact) l->term[i].stiffness(l->term[i].self, x, force, how, a);
}
