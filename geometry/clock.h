/* clock: seconds for the records; results never depend on them. */
#pragma once
#include <time.h>

static inline double clock_read_s(clockid_t which)
{
    struct timespec t;
    clock_gettime(which, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline double clock_s(void) { return clock_read_s(CLOCK_MONOTONIC); }              /* wall */
static inline double clock_cpu_s(void) { return clock_read_s(CLOCK_PROCESS_CPUTIME_ID); } /* of all threads */

typedef struct clock_span { /* what a stage took */
    double wall_s, cpu_s;
} clock_span;

static inline clock_span clock_sum(clock_span a, clock_span b)
{
    return (clock_span){a.wall_s + b.wall_s, a.cpu_s + b.cpu_s};
}
static inline clock_span clock_now(void) { return (clock_span){clock_s(), clock_cpu_s()}; }
/* Since *begin, which becomes now. */
static inline clock_span clock_lap(clock_span *begin)
{
    clock_span now = clock_now(), out = {now.wall_s - begin->wall_s, now.cpu_s - begin->cpu_s};
    *begin = now;
    return out;
}
