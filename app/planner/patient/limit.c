#include "app/planner/patient/limit.h"

const limit limit_default[LIMIT_COUNT] = {
#define X(id, field, unit_, fine0, fine1, stop0, stop1, what_, source_)                                                \
    {.name = #field, .unit = unit_, .what = what_, .source = source_, .range = {{fine0, fine1}, {stop0, stop1}}},
    LIMITS(X)
#undef X
};

static const double rounding = 1e-6;

static bool within(const double range[2], double value)
{
    return (range[0] <= -LIMIT_OPEN || value >= range[0] - rounding) &&
           (range[1] >= LIMIT_OPEN || value <= range[1] + rounding);
}

limit_level limit_judge(const limit_range *r, double value)
{
    if (isnan(value)) return LIMIT_NOT_JUDGED;
    return !within(r->stop, value) ? LIMIT_STOP : within(r->fine, value) ? LIMIT_FINE : LIMIT_CAUTION;
}

double limit_margin(const limit_range *r, double value)
{
    bool never_negative = r->stop[0] == 0 && r->fine[0] == 0;
    double below = r->stop[0] <= -LIMIT_OPEN || never_negative ? HUGE_VAL : value - r->stop[0],
           above = r->stop[1] >= LIMIT_OPEN ? HUGE_VAL : r->stop[1] - value;
    return fmin(below, above);
}

const char *limit_level_name(limit_level level)
{
    static const char *const names[] = {"not judged", "fine", "caution", "stop"};
    return names[level];
}
