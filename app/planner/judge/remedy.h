/* remedy: the smallest single change of a plan that brings a limit back to the next better level. */
#pragma once
#include "app/planner/judge/judge.h"

enum { REMEDY_TEXT_SIZE = 96 };

/* Tries, for every segment that the plan moves, shifts of up to 4.5 mm along the head's axes and less of each angle; by
 * bisection to 0.05 mm or degrees. A change that makes any limit worse by a level does not count. False (and "") where
 * none helps. `which` is the number of the finding in `now`, the judgement of the plan. */
bool remedy_find(const judge *j, const case_file *c, const prepared *p, const plan_file *plan, const judgement *now,
                 int which, char text[REMEDY_TEXT_SIZE]);
