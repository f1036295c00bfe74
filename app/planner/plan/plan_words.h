/* plan_words: what a plan and its transforms are called, against what they do: a transform in RAS or its inverse moves
 * a bone the other way, one in metres hardly at all, one of another bone about another place. */
#pragma once
#include "app/planner/plan/plan_moves.h"

/* Adds warnings. move: as of plan_moves. */
void plan_words_check(const plan_file *p, const rigid move[SEGMENT_COUNT], const landmarks *l, const head_frame *f,
                      issue_list *issues);
