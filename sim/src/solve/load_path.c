#include "sim/src/solve/load_path.h"
#include <math.h>

static void aim(load_path *p)
{
    p->target = p->reached + p->step;
    if (p->phase == PATH_GUESS || p->target > 1 - 1e-9) p->target = 1;
}

load_path load_path_begin(bool from_guess, bool held_contact, int steps, int most_halvings)
{
    load_path p = {.phase = from_guess     ? PATH_GUESS
                            : held_contact ? PATH_LATE
                                           : PATH_EVERY,
                   .step = 1.0 / steps,
                   .longest = 1.0 / steps,
                   .most_halvings = most_halvings};
    aim(&p);
    return p;
}

static void advance(load_path *p)
{
    p->reached = p->target;
    if (++p->eased >= 2) p->step = fmin(2 * p->step, p->longest);
    if (!(p->reached < 1)) p->phase = PATH_REACHED;
}

static void ease(load_path *p)
{
    if (p->halvings >= p->most_halvings) {
        p->phase = PATH_STOPPED;
        return;
    }
    p->halvings++;
    p->eased = 0;
    p->step = (p->target - p->reached) / 2;
}

static void begin_at_rest(load_path *p)
{
    if (p->most_halvings == 0) {
        p->phase = PATH_STOPPED;
        return;
    }
    p->halvings++;
    p->reached = 0;
    p->phase = PATH_EVERY;
}

void load_path_go_on(load_path *p, bool solved)
{
    if (solved)
        advance(p);
    else if (p->phase == PATH_EVERY)
        ease(p);
    else
        begin_at_rest(p);
    if (p->phase != PATH_REACHED && p->phase != PATH_STOPPED) aim(p);
}

bool load_path_touches(const load_path *p) { return p->phase != PATH_LATE || p->target >= 1; }

bool load_path_first_touch(const load_path *p)
{
    if (p->phase == PATH_LATE) return p->target >= 1;
    return p->phase == PATH_EVERY && p->reached == 0;
}
