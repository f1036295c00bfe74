/* audit: the two halves of gnathos audit, one plan (audit_plan.c) and what is possible (audit_space.c). */
#pragma once
#include "app/cli/verb.h"

enum { AUDIT_WORDS_MAX = 10 };

typedef struct audit_options { /* of the second half */
    const char *named;         /* the last of them that was given */
    const char *around;
    bool no_pictures, geometry_only;
    double spacing, tolerance;
    int word_count;
    const char *word[AUDIT_WORDS_MAX]; /* of --line, --pair, --box */
    int axis_count[AUDIT_WORDS_MAX];   /* 1, 2, 3 */
    bool one_plan;                     /* the first half */
} audit_options;

/* Prints the table, or JSON. Exit status 6 where the plan goes beyond a limit and has no override. */
bool audit_plan_run(run_context *r, err *e);
/* What is wrong in the words. */
bool audit_space_early(run_context *r, err *e);
bool audit_space_run(run_context *r, err *e);
