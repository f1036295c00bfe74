/* judge_parts: what the files of judge share. */
#pragma once
#include "app/judge.h"

struct judge {
    const case_file *patient;
    const prepared *prepared;
    int *carrier; /* [points.count] the segment each landmark moves with */
    bool jaws_apart; /* the scan shows the jaws out of occlusion */
};

/* Where the plan puts a landmark; false if the case has none. */
bool judge_landmark(const judge *j, const plan_moves *m, const char *label, double out[3]);

void judge_moves(const judge *j, const plan_moves *m, judgement *out);
void judge_bite(const judge *j, const plan_moves *m, judgement *out);
void judge_cuts(const judge *j, judgement *out);
