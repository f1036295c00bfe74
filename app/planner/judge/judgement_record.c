#include "app/planner/judge/judgement_record.h"
#include <stdio.h>
#include <string.h>

typedef struct judged { /* a finding with what its limit says */
    const char *limit, *where, *what, *source, *unit, *segment, *other, *note;
    limit_level level;
    double value, scan, fine[2], stop[2], margin, place[3];
    bool estimated, has_place;
} judged;

static bool has_place(const void *of) { return ((const judged *)of)->has_place; }

static const record_row judged_row[] = {
    ROW(judged, limit, "limit", NULL, "name of the limit"),
    ROW(judged, where, "where", NULL, "side or place, empty where there is but one"),
    ROW(judged, what, "what", NULL, "what it limits"),
    ROW_WORD(judged, level, "level", LEVEL_WORDS, "how the plan stands to it"),
    ROW(judged, value, "value", NULL, "what the plan makes of it, in its unit"),
    ROW_OPTIONAL(judged, scan, "scan", NULL, "the same in the scan, before the plan"),
    ROW(judged, fine, "fine", NULL, "range that is fine; null: open"),
    ROW(judged, stop, "stop", NULL, "range beyond which the plan must say why; null: open"),
    ROW(judged, margin, "margin", NULL, "to the nearer end of that range, positive inside"),
    ROW(judged, estimated, "estimated", NULL, "it rests on an estimated point, so that it is caution at most"),
    ROW(judged, source, "source", NULL, "where the limit comes from"),
    ROW_OPTIONAL(judged, unit, "unit", NULL, "unit of the numbers"),
    ROW_WHEN(has_place, judged, place, "place_lps_mm", "LPS mm", "where it is, with the bones as planned"),
    ROW_OPTIONAL(judged, segment, "segment", NULL, "the bone it is about"),
    ROW_OPTIONAL(judged, other, "other_segment", NULL, "and the other one"),
    ROW_OPTIONAL(judged, note, "note", NULL, "why it is not judged, or what to know"),
};
static const record_table judged_table = {.title = "A finding", RECORD_ROWS(judged_row)};

static const char *text_or_null(const char *text) { return *text ? text : NULL; }

static const void *next_finding(const void *of, int *i, const char **key, void *space)
{
    const judgement_record *r = of;
    (void)key;
    if (*i >= r->judgement->count) return NULL;
    const finding *f = &r->judgement->finding[*i];
    const limit *l = &limit_default[f->limit];
    const limit_range *range = &r->patient->limits[f->limit];
    judged *out = space;
    _Static_assert(sizeof *out <= RECORD_SPACE, "a finding fits");
    *out = (judged){.limit = l->name,
                    .where = f->where,
                    .what = l->what,
                    .source = r->patient->limit_from_case[f->limit] ? "set by the case" : l->source,
                    .unit = text_or_null(l->unit),
                    .segment = f->segment_a >= 0 ? segment_name((segment_id)f->segment_a) : NULL,
                    .other = f->segment_b >= 0 ? segment_name((segment_id)f->segment_b) : NULL,
                    .note = f->note,
                    .level = f->level,
                    .value = f->value,
                    .scan = f->scan,
                    .margin = f->margin,
                    .estimated = f->estimated,
                    .has_place = f->has_place};
    memcpy(out->fine, range->fine, sizeof out->fine);
    memcpy(out->stop, range->stop, sizeof out->stop);
    memcpy(out->place, f->place, sizeof out->place);
    return out;
}

#define JUDGEMENT_ROWS                                                                                                 \
    ROW_WORD(judgement_record, worst, "worst", LEVEL_WORDS, "the worst level of all"),                                 \
        ROW(judgement_record, override, "override", NULL,                                                              \
            "why the plan may go beyond limits, empty where it may not"),                                              \
        ROW_LIST(next_finding, &judged_table, "limits", "every limit, in a fixed order"),                              \
        ROW_OPTIONAL(judgement_record, decides, "decides", NULL, "the limit that decides: of the worst, the nearest")

static const record_row judgement_row[] = {JUDGEMENT_ROWS};
const record_table judgement_table = {.title = "Judgement of a plan", RECORD_ROWS(judgement_row)};

judgement_record judgement_record_of(const judgement *j, const case_file *c, const char *override)
{
    return (judgement_record){.worst = j->worst,
                              .decides = j->reason >= 0 ? limit_default[j->finding[j->reason].limit].name : NULL,
                              .override = override,
                              .judgement = j,
                              .patient = c};
}

static const record_row change_row[] = {
    ROW(remedy_change, control, "control", NULL, "name of the control"),
    ROW(remedy_change, unit, "unit", NULL, "mm or deg"),
    ROW(remedy_change, by, "by", NULL, "how much more than wanted, in that unit"),
    ROW(remedy_change, wanted, "wanted", NULL, "as in the plan; null: a matrix moves the piece"),
    ROW(remedy_change, proposed, "proposed", NULL, "as in the remedy"),
};
static const record_table change_table = {.title = "A change of a remedy", RECORD_ROWS(change_row)};

static const void *next_change(const void *of, int *i, const char **key, void *space)
{
    const remedy *r = of;
    (void)key, (void)space;
    return *i < r->change_count ? &r->change[*i] : NULL;
}

static const void *next_stop(const void *of, int *i, const char **key, void *space)
{
    const judgement *j = &((const remedy *)of)->after;
    (void)key;
    while (*i < j->count && j->finding[*i].level != LIMIT_STOP) ++*i;
    if (*i >= j->count) return NULL;
    const finding *f = &j->finding[*i];
    snprintf(space, RECORD_SPACE, "%s%s%s", limit_default[f->limit].name, *f->where ? ", " : "", f->where);
    return space;
}

static const record_row remedy_row[] = {
    ROW(remedy, found, "found", NULL, "there is one"),
    ROW_LIST(next_change, &change_table, "changes", "of the plan, all together; judged again, nothing stops it then"),
    ROW_TEXTS(next_stop, "contradict", "where none is found: limits that stop the moves that come nearest"),
};
static const record_table remedy_table = {.title = "The nearest plan of the same pieces that nothing stops",
                                          RECORD_ROWS(remedy_row)};

static const void *sought_remedy(const void *of, void *space)
{
    const plan_audit *a = ((const judgement_record *)of)->audit;
    (void)space;
    return a->remedy.sought ? &a->remedy : NULL;
}

static const record_row plan_audit_row[] = {
    JUDGEMENT_ROWS,
    ROW(judgement_record, case_name, "case", NULL, "name of the case"),
    ROW(judgement_record, plan, "plan", NULL, "name of the plan"),
    ROW(judgement_record, feasible, "feasible", NULL, "nothing stops it, or it says why"),
    {.kind = RECORD_OBJECT,
     .at = sought_remedy,
     .table = &remedy_table,
     .or_null = true,
     .name = "remedy",
     .help = "the nearest plan of the same pieces that nothing stops; null: nothing stops this one"},
};
const record_table plan_audit_table = {
    .kind = "plan_audit", .title = "Record of gnathos audit --plan, audit.json", RECORD_ROWS(plan_audit_row)};

json_t *plan_audit_json(const plan_audit *a)
{
    judgement_record r = judgement_record_of(&a->judgement, a->patient, a->plan->override);
    r.audit = a;
    r.case_name = a->patient->name;
    r.plan = a->plan->name;
    r.feasible = !plan_audit_infeasible(a);
    return record_json(&plan_audit_table, &r);
}
