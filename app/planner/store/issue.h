/* issue: everything that is wrong with an input, not only the first thing. */
#pragma once
#include "geometry/err.h"

/* Control bytes in names and texts are kept as \xNN, so that a message is one line whatever it quotes. */

typedef enum issue_level { ISSUE_ERROR, ISSUE_WARNING, ISSUE_INFO } issue_level;

typedef struct issue {
    issue_level level;
    err_code code;      /* of an error: the exit status it stands for */
    int line;           /* 0: none */
    char *file, *field; /* NULL: none */
    char *text;
} issue;

enum { ISSUES_MOST = 100 }; /* of a level that are kept and told; the others are counted */

typedef struct issue_list {
    int count; /* kept */
    issue *item;
    int kept[3], left_out[3]; /* by level */
} issue_list;

void issue_add(issue_list *l, issue_level level, err_code code, const char *file, int line, const char *field,
               const char *fmt, ...) PRINTF_LIKE(7, 8);
/* Takes over a filled err; "file:line: " at the start of its text becomes file and line. */
void issue_add_err(issue_list *l, issue_level level, const err *e, const char *file);
/* Orders the issues from number `from` on by line; equals stay in order. */
void issue_sort_by_line(issue_list *l, int from);
/* True, and one more is counted as left out, where as many of the level are kept as are told. */
bool issue_leave_out(issue_list *l, issue_level level);
/* Kept and left out. */
int issue_count(const issue_list *l, issue_level level);
/* True if no issue is an error; else fills e with the first one. */
bool issue_none_is_error(const issue_list *l, err *e) MUST_CHECK;
void issue_list_free(issue_list *l);
const char *issue_level_name(issue_level level); /* "error", "warning", "info" */
