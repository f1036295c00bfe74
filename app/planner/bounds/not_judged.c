/* What an audit says nothing about, so that nothing is fine in silence. */
#include "app/planner/bounds/audit.h"
#include <stdio.h>
#include <string.h>

static void add(json_t *list, limit_id id, const char *why)
{
    const limit *l = &limit_default[id];
    json_array_append_new(list, json_pack("{ss ss ss}", "limit", l->name, "what", l->what, "why", why));
}

bool audit_not_judged(const audit *a, json_t **out, err *e)
{
    static const char *const face =
        "needs the predicted face, see gnathos predict: the bones alone do not tell, since the lip follows 0.2 to 0.5 of "
        "an impaction and of a lengthening no number is published";
    int32_t base[SAMPLE_AXES_MAX] = {0};
    judgement j;
    plan_moves moves;
    if (!audit_judge(a, base, &j, &moves, e)) return false;
    *out = json_array();
    for (int i = 0; i < j.count; i++)
        if (j.finding[i].level == LIMIT_NOT_JUDGED) add(*out, j.finding[i].limit, j.finding[i].note);
    for (int l = LIMIT_SOLVED; l <= LIMIT_STRETCH && !a->tissue_asked; l++)
        add(*out, (limit_id)l, "the soft tissue was not asked");
    add(*out, LIMIT_INCISOR_SHOW, face);
    add(*out, LIMIT_LOWER_FACE, face);
    return true;
}

bool audit_print_not_judged(const audit *a, err *e)
{
    json_t *list, *o;
    size_t i;
    if (!audit_not_judged(a, &list, e)) return false;
    printf("\nnot judged:\n");
    json_array_foreach(list, i, o)
    {
        const char *why = json_string_value(json_object_get(o, "why"));
        const json_t *after = json_array_get(list, i + 1); /* limits with the same reason stand in one line */
        bool last = !after || strcmp(json_string_value(json_object_get(after, "why")), why) != 0;
        printf("%s%s", json_string_value(json_object_get(o, "what")), last ? ": " : "; ");
        if (last) printf("%s\n", why);
    }
    json_decref(list);
    return true;
}
