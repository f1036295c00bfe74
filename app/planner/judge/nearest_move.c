#include "app/planner/judge/nearest_move.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SWEEPS = 4000 };
static const double softness = 1e-3; /* of a limit's breach, in lengths squared per length squared */
static const double still = 1e-9;

void nearest_move(const move_limit *limit, int count, int axes, double x[])
{
    double *pull = NEW_ARRAY(double, count ? count : 1); /* how hard each limit draws, >= 0 */
    memset(x, 0, sizeof *x * (size_t)axes);
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        double largest = 0;
        for (int i = 0; i < count; i++) {
            double reached = 0;
            for (int k = 0; k < axes; k++) reached += limit[i].towards[k] * x[k];
            double more = (limit[i].least - reached - softness * pull[i]) / (1 + softness);
            more = fmax(more, -pull[i]);
            pull[i] += more;
            for (int k = 0; k < axes; k++) x[k] += more * limit[i].towards[k];
            largest = fmax(largest, fabs(more));
        }
        if (largest < still) break;
    }
    free(pull);
}
