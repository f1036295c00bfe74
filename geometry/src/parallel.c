#include "geometry/parallel.h"
#include <omp.h>

static _Atomic int thread_count; /* 0: one per core */

void parallel_set_threads(int threads) { thread_count = threads; }

int parallel_threads(void)
{
    int asked = thread_count;
    return asked > 0 ? asked : omp_get_num_procs();
}

int parallel_forbid(void)
{
    int levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
    return levels;
}

void parallel_allow(int levels) { omp_set_max_active_levels(levels); }

void parallel_for(int64_t count, int64_t grain, parallel_body *body, void *context)
{
    if (grain < 1) grain = 1;
    int64_t blocks = (count + grain - 1) / grain;
#pragma omp parallel for schedule(dynamic) num_threads(parallel_threads()) if (blocks > 1)
    for (int64_t b = 0; b < blocks; b++) body(b * grain, (b + 1) * grain < count ? (b + 1) * grain : count, context);
}
