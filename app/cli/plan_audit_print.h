/* plan_audit_print: a judged plan on stdout. */
#pragma once
#include "app/planner/judge/plan_audit.h"

/* One line for each limit, the worst first, with what would help. */
void plan_audit_print(const plan_audit *a);
/* One line for each stop, and how many cautions there are. */
void judgement_print_brief(const judgement *j, const case_file *c);
