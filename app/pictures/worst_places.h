/* judge_picture: the worst places of a judged plan on the bones as planned. */
#pragma once
#include "app/planner/judge/judge.h"

/* One sheet: front and sides, and close-ups of the places that decide. Overlap red, parted cut faces blue, the canal
 * (estimated) yellow, findings of caution and stop as balls with their names. Refuses what the renderer refuses. */
bool judge_picture_write(const judge *j, const plan_moves *m, const judgement *now, const char *title, const char *path,
                         err *e) MUST_CHECK;
