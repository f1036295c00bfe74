#include "app/planner/judge/judgement.h"
#include <assert.h>

finding *judgement_add(judgement *out, const case_file *c, limit_id id, const char *where, double value, bool estimated,
                       const char *note)
{
    assert(out->count < FINDINGS_MAX);
    finding *f = &out->finding[out->count];
    *f = (finding){.limit = id,
                   .where = where,
                   .value = value,
                   .scan = (double)NAN,
                   .level = limit_judge(&c->limits[id], value),
                   .margin = isnan(value) ? HUGE_VAL : limit_margin(&c->limits[id], value),
                   .estimated = estimated,
                   .segment_a = -1,
                   .segment_b = -1,
                   .note = note};
    if (estimated && f->level == LIMIT_STOP) f->level = LIMIT_CAUTION;
    const finding *first = out->reason >= 0 ? &out->finding[out->reason] : NULL;
    if (f->level > out->worst || (f->level == out->worst && first && !first->leads && f->margin < first->margin))
        out->reason = out->count;
    if (f->level > out->worst) out->worst = f->level;
    out->count++;
    return f;
}

void judgement_lead(judgement *out)
{
    finding *f = &out->finding[out->count - 1];
    f->leads = f->level >= LIMIT_CAUTION;
    if (f->leads && f->level == out->worst) out->reason = out->count - 1;
}
