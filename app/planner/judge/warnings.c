/* What was doubtful about the case when it was checked and cut: a finding each, so that no face comes without them. */
#include "app/planner/judge/parts.h"
#include "app/planner/patient/case_warnings.h"

enum { TOLD_MOST = 40 };

void judge_warnings(const judge *j, judgement *out)
{
    case_warnings w;
    case_warnings_read(json_object_get(j->prepared->report, "warnings"), &w);
    if (!w.count) judgement_add(out, j->patient, LIMIT_CASE_WARNINGS, "", 0, false, NULL);
    for (int i = 0; i < w.count && i < TOLD_MOST; i++) {
        const case_warning *one = &w.item[i];
        judgement_add(out, j->patient, LIMIT_CASE_WARNINGS, one->field ? one->field : one->part, 1, false, one->text);
    }
    if (w.count > TOLD_MOST)
        judgement_add(out, j->patient, LIMIT_CASE_WARNINGS, "", w.count - TOLD_MOST, false,
                      "so many more, which gnathos prepare names");
    case_warnings_free(&w);
}
