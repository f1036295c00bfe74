/* plan_audit_print: a judged plan on stdout. */
#pragma once
#include "app/planner/judge/plan_audit.h"

/* One line for each limit, the worst first, and the remedy of a plan that is stopped. */
void plan_audit_print(const plan_audit *a);
/* What stops a plan, or leads what is said of it, for the first line; nothing where there is none. */
void judgement_print_headline(const judgement *j, const case_file *c);
/* One line for each stop, and how many cautions there are. */
void judgement_print_brief(const judgement *j, const case_file *c);
