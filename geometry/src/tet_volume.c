#include "geometry/tet_volume.h"
#include <math.h>

double tets_min_j(const tetmesh *m, const double *x, int32_t *inverted)
{
    double least = HUGE_VAL;
    int32_t count = 0;
    for (int32_t t = 0; t < m->tet_count; t++) {
        double j = tet_j(m, x, t);
        least = fmin(least, j);
        count += !(j > 0);
    }
    if (inverted) *inverted = count;
    return least;
}
