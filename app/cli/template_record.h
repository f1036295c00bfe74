/* template_record: what gnathos template prints with --json. */
#pragma once
#include "app/planner/identity/template_get.h"
#include "app/planner/store/record.h"

typedef struct template_record {
    const head_template *head;
    const template_source *source;
} template_record;
extern const record_table template_record_table; /* kind "template" */
