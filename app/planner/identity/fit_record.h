/* fit_record: what gnathos fit writes as fit.json and prints with --json. */
#pragma once
#include "app/planner/identity/head_complete.h"
#include "app/planner/store/record.h"

typedef struct fit_record {
    const char *patient; /* path of the case */
    const head_template *head;
    const head_scan *scan;
    const head_fit *fit;
    const char *told;                  /* "" or what the place found out of the ordinary */
    const head_completion *completion; /* NULL: the fit was not completed */
} fit_record;
extern const record_table fit_record_table; /* kind "fit" */

/* Share of the part's vertices that are not the scan's for a reason, and of those that are guessed: absent, closed. */
double fit_share(const head_fit *f, case_surface part, head_guess why);
double fit_guessed_share(const head_fit *f, case_surface part);
/* Whether the landmark hangs where the scan has nothing; those inside are as their part is for the most. */
bool fit_point_is_guessed(const fit_record *r, const head_point *p);
/* As the case of the fitted head says it. */
case_guess fit_case_guess(const fit_record *r);
