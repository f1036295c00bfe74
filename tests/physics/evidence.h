/* evidence: numbers that a test measured, for the table "Verification" of tests/EVIDENCE.md: tests/evidence.sh collects
 * every line "evidence: WHAT VALUE UNIT" that a physics test prints. WHAT may hold spaces but no '|'; UNIT is one word,
 * "-" for none. Measure what the test asserts. */
#pragma once
#include "tests/check.h"

static inline void evidence(const char *what, double value, const char *unit)
{
    print_message("evidence: %s %.3g %s\n", what, value, unit);
}

/* Returns `off` as it is and keeps the largest size of all that were given. */
static inline double keep_worst(double *worst, double off)
{
    *worst = fmax(*worst, fabs(off));
    return off;
}
