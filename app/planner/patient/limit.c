#include "app/planner/patient/limit.h"
#include <stdio.h>

const limit limit_default[LIMIT_COUNT] = {
#define X(id, field, unit_, fine0, fine1, stop0, stop1, what_, source_)                                                \
    {.name = #field, .unit = unit_, .what = what_, .source = source_, .range = {{fine0, fine1}, {stop0, stop1}}},
    LIMITS(X)
#undef X
};

static const double rounding = 1e-6;

static bool within(const double range[2], double value)
{
    return value >= range[0] - rounding && value <= range[1] + rounding;
}

limit_level limit_judge(const limit_range *r, double value)
{
    if (isnan(value)) return LIMIT_NOT_JUDGED;
    return !within(r->stop, value) ? LIMIT_STOP : within(r->fine, value) ? LIMIT_FINE : LIMIT_CAUTION;
}

double limit_margin(const limit_range *r, double value)
{
    bool never_negative = r->stop[0] == 0 && r->fine[0] == 0;
    return fmin(never_negative ? LIMIT_OPEN : value - r->stop[0], r->stop[1] - value);
}

const char *limit_level_name(limit_level level)
{
    static const char *const names[] = {"not judged", "fine", "caution", "stop"};
    return names[level];
}

const char *limit_range_words(const double r[2], char text[LIMIT_WORDS_SIZE])
{
    bool low = r[0] > -LIMIT_OPEN, high = r[1] < LIMIT_OPEN;
    if (low && high)
        snprintf(text, LIMIT_WORDS_SIZE, "%g to %g", r[0], r[1]);
    else if (low || high)
        snprintf(text, LIMIT_WORDS_SIZE, "at %s %g", low ? "least" : "most", low ? r[0] : r[1]);
    else
        snprintf(text, LIMIT_WORDS_SIZE, "-");
    return text;
}
