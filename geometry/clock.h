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
