/* case_warnings: what is doubtful about a case, as `gnathos check` and the cuts told it when it was prepared. It is
 * kept with what is prepared, told again by every verb that uses that, and a finding of every judgement. */
#pragma once
#include "app/planner/patient/case_file.h"
#include "app/planner/store/record.h"

typedef struct case_warning {
    const char *part;  /* "skin" ... "lower_teeth", "landmarks", "planes", "case", "cuts" */
    const char *field; /* "U1", or NULL */
    const char *text;
} case_warning;

extern const record_table case_warning_table; /* of a case_warning */

typedef struct case_warnings {
    int count;
    case_warning *item;
    char more[80]; /* text of the last one, where some were left out */
} case_warnings;

/* Of the warnings in a list, whose texts it borrows. The caller frees *out. */
void case_warnings_make(const case_file *c, const issue_list *from, case_warnings *out);
void case_warnings_free(case_warnings *w);

/* Of a record, as case_warning_table wrote it (a list, or NULL); what is no warning is left out. Texts are borrowed. */
void case_warnings_read(const json_t *list, case_warnings *out);
/* As they were told, with the paths that the case has now. */
void case_warnings_issues(const case_warnings *w, const case_file *c, issue_list *out);
