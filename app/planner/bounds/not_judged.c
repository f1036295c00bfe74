/* What an audit says nothing about, so that nothing is fine in silence. */
#include "app/planner/bounds/audit.h"
#include <assert.h>

static void add(audit_gap *out, int *count, limit_id id, const char *why)
{
    const limit *l = &limit_default[id];
    assert(*count < AUDIT_GAPS_MAX);
    out[(*count)++] = (audit_gap){l->name, l->what, why};
}

bool audit_not_judged(const audit *a, audit_gap out[AUDIT_GAPS_MAX], int *count, err *e)
{
    static const char *const face =
        "needs the predicted face, see gnathos predict: the bones alone do not tell, since the lip follows 0.2 to 0.5 of "
        "an impaction and of a lengthening no number is published";
    int32_t base[SAMPLE_AXES_MAX] = {0};
    judgement j;
    plan_moves moves;
    if (!audit_judge(a, base, &j, &moves, e)) return false;
    *count = 0;
    for (int i = 0; i < j.count; i++)
        if (j.finding[i].level == LIMIT_NOT_JUDGED) add(out, count, j.finding[i].limit, j.finding[i].note);
    for (int l = LIMIT_SOLVED; l <= LIMIT_STRETCH && !a->tissue_asked; l++)
        add(out, count, (limit_id)l, "the soft tissue was not asked");
    add(out, count, LIMIT_INCISOR_SHOW, face);
    add(out, count, LIMIT_LOWER_FACE, face);
    return true;
}
