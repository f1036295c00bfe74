/* issue: everything that is wrong with an input, not only the first thing. */
#pragma once
#include "geometry/err.h"

typedef enum issue_level { ISSUE_ERROR, ISSUE_WARNING, ISSUE_INFO } issue_level;

typedef struct issue {
    issue_level level;
    err_code code;      /* of an error: the exit status it stands for */
    int line;           /* 0: none */
    char *file, *field; /* NULL: none */
    char *text;
} issue;

typedef struct issue_list {
    int count;
    issue *item;
} issue_list;

void issue_add(issue_list *l, issue_level level, err_code code, const char *file, int line, const char *field,
               const char *fmt, ...) PRINTF_LIKE(7, 8);
/* Takes over a filled err; "file:line: " at the start of its text becomes file and line. */
void issue_add_err(issue_list *l, issue_level level, const err *e, const char *file);
/* Orders the issues from number `from` on by line; equals stay in order. */
void issue_sort_by_line(issue_list *l, int from);
int issue_count(const issue_list *l, issue_level level);
/* True if no issue is an error; else fills e with the first one. */
bool issue_none_is_error(const issue_list *l, err *e) MUST_CHECK;
void issue_list_free(issue_list *l);
const char *issue_level_name(issue_level level); /* "error", "warning", "info" */
