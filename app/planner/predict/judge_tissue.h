/* judge_tissue: the limits that only the solved soft tissue answers. */
#pragma once
#include "app/planner/predict/carried.h"
#include "app/planner/judge/judgement.h"
#include "sim/equilibrium.h"

/* Appends them to the judgement of the bones. points NULL (the solve failed): what needs the face is not judged. */
void judge_tissue(const case_file *c, const prepared *p, const equilibrium *q, const carried_landmarks *points,
                  judgement *io);
