/* judgement: what was found when a plan was judged, limit by limit, and what decides.
 *
 * What cannot be judged on a case is a finding of level LIMIT_NOT_JUDGED with the reason, so that nothing is fine in
 * silence. */
#pragma once
#include "app/planner/patient/case_file.h"

enum { FINDINGS_MAX = 256 }; /* a class III head with all cuts has 98 */

typedef struct finding {
    limit_id limit;
    const char *where; /* "left", "piriform rim right", or "" */
    double value;      /* in the limit's unit; NaN: not judged */
    double scan;       /* the same before the plan; NaN: not told */
    limit_level level;
    double margin;  /* to the stop, > 0 inside, infinite where there is none */
    bool estimated; /* rests on an estimated point, so that it is caution at most */
    bool leads;     /* decides before others of its level, whatever their margins */
    bool has_place;
    double place[3];          /* LPS mm, with the bones as planned */
    int segment_a, segment_b; /* the bones it is about, or -1 */
    const char *note;         /* why it is not judged, or what to know; NULL */
} finding;

typedef struct judgement {
    int count;
    finding finding[FINDINGS_MAX];
    limit_level worst;
    int reason; /* number of the finding that decides: of the worst level, the smallest margin; -1: none */
} judgement;

/* Appends a finding and keeps worst and reason; value NaN with a note: not judged. Returns it, to be filled further
 * (before the next one). */
finding *judgement_add(judgement *out, const case_file *c, limit_id id, const char *where, double value, bool estimated,
                       const char *note);
/* The finding added last leads. */
void judgement_lead(judgement *out);
