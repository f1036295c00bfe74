/* report_page: an outcome as one HTML page that needs nothing else, from disk and without a network. */
#pragma once
#include "app/planner/predict/outcome_read.h"

typedef struct report_params {
    const char *pictures; /* folder of the report_stills that the page shows; NULL: none */
    const json_t *audit;  /* of report_audit(), or NULL */
    bool names;           /* show the names of case and plan and all other text of the user */
} report_params;

/* The outcome has passed report_record_check(). *bytes: the size of the page. Refuses (ERR_INPUT) a missing picture,
 * (ERR_RESOURCE) what the disk refuses. */
bool report_page_write(const outcome_shapes *o, const report_params *params, const char *path, size_t *bytes,
                       err *e) MUST_CHECK;
