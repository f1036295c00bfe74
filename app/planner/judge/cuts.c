/* The clearances that the cuts keep, as measured when the bones were cut; they are in the prepared report. */
#include "app/planner/judge/parts.h"
#include <string.h>

static limit_id limit_of(const char *what)
{
    static const struct {
        const char *word;
        limit_id limit;
    } table[] = {{"apex", LIMIT_ROOT_CLEARANCE},
                 {"foramen", LIMIT_FORAMEN_CLEARANCE},
                 {"canal", LIMIT_NERVE_CLEARANCE},
                 {"chin height", LIMIT_CHIN_HEIGHT}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strstr(what, table[i].word)) return table[i].limit;
    return LIMIT_CUT_MARGIN;
}

void judge_cuts(const judge *j, judgement *out)
{
    const json_t *list = json_object_get(json_object_get(j->prepared->report, "cuts"), "clearance");
    for (int l = LIMIT_ROOT_CLEARANCE; l <= LIMIT_CUT_MARGIN; l++) {
        size_t i;
        json_t *item;
        bool any = false;
        json_array_foreach((json_t *)list, i, item)
        {
            const char *what = json_string_value(json_object_get(item, "what"));
            double mm = json_number_value(json_object_get(item, "value_mm")),
                   least = json_number_value(json_object_get(item, "limit_mm"));
            if (!what || (int)limit_of(what) != l) continue;
            any = true;
            judgement_add(out, j->patient, (limit_id)l, what, l == LIMIT_CUT_MARGIN ? mm - least : mm,
                          json_is_true(json_object_get(item, "estimated")), NULL);
        }
        if (!any)
            judgement_add(out, j->patient, (limit_id)l, "", (double)NAN, false,
                          "no such cut, or its landmarks are missing; see gnathos cut");
    }
}
