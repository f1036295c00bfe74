/* judgement_record: findings of a plan in a record: in outcome.json, in the audit.json of a plan, and alone. */
#pragma once
#include "app/planner/judge/plan_audit.h"
#include "app/planner/store/record.h"

#define LEVEL_WORDS "not judged|fine|caution|stop" /* limit_level_name of each */

typedef struct judgement_record {
    limit_level worst;
    const char *decides; /* name of the limit; NULL: none */
    const char *override;
    const judgement *judgement;
    const case_file *patient;
    const plan_audit *audit;      /* of a plan's audit; NULL */
    const char *case_name, *plan; /* of a plan's audit */
    bool feasible;
} judgement_record;
extern const record_table judgement_table;
judgement_record judgement_record_of(const judgement *j, const case_file *c, const char *override);

extern const record_table plan_audit_table; /* kind "plan_audit": audit.json of gnathos audit --plan */
json_t *plan_audit_json(const plan_audit *a);
