/* remedy: one plan that nothing stops, as near as can be found to a wanted one that something does. */
#pragma once
#include "app/planner/judge/judge.h"

typedef struct remedy_change { /* of one control; all changes together are the remedy */
    char control[40];
    const char *unit;
    double by, wanted, proposed; /* mm or degrees; wanted and proposed are NaN where a matrix moves the piece */
} remedy_change;

typedef struct remedy {
    bool sought, found; /* sought: the wanted plan is stopped */
    int change_count;
    remedy_change change[CONTROL_PIECE_MAX]; /* where found */
    plan_file plan;                          /* where found, without an override */
    judgement after; /* found: of that plan. Else: of the moves that come nearest; what stops them contradicts */
} remedy;

/* Changes every piece that the plan moves, along the head's axes and, of the angles that the plan has, to less; a
 * millimetre counts like a degree. Steps by the limits' margins, as straight as they are there, towards the nearest
 * plan that has all of them (sequential quadratic programming with soft limits), rounds to 0.1, 0.05 or 0.01 and judges
 * that again: a plan is found only if nothing stops it then. It is a local search: none found does not prove that there
 * is none. `now` is the judgement of the plan. Same bits for any number of threads. */
void remedy_find(const judge *j, const case_file *c, const prepared *p, const plan_file *plan, const judgement *now,
                 remedy *out);
