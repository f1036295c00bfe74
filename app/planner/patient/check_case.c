#include "app/planner/patient/check.h"
#include <stdio.h>
#include <string.h>

void check_case(const case_file *c, const task *watch, check_found *found, issue_list *issues)
{
    task_progress(watch, "surfaces", -1);
    check_surfaces(c, found, issues);
    if (task_interrupted(watch)) return;
    check_bones_inside(c, found, issues);
    task_progress(watch, "landmarks", -1);
    check_landmarks(c, found, issues);
    check_guessed(c, found, issues);
    check_planes(c, issues);
}

static void count_others(int errors, err *e)
{
    size_t n = strlen(e->text);
    if (errors > 1)
        snprintf(e->text + n, sizeof e->text - n, " (gnathos check names %d more error%s)", errors - 1,
                 errors > 2 ? "s" : "");
}

bool check_case_passes(const case_file *c, const task *watch, issue_list *warnings, err *e)
{
    check_found found = {0};
    issue_list all = {0};
    check_case(c, watch, &found, &all);
    check_found_free(&found);
    bool passed = issue_none_is_error(&all, e), ok = passed && !task_interrupted(watch);
    if (!passed) count_others(issue_count(&all, ISSUE_ERROR), e);
    if (passed && !ok) err_set(e, ERR_INTERRUPTED, "interrupted");
    for (int i = 0; ok && i < all.count; i++) {
        const issue *one = &all.item[i];
        if (one->level == ISSUE_WARNING)
            issue_add(warnings, one->level, one->code, one->file, one->line, one->field, "%s", one->text);
    }
    if (ok) warnings->left_out[ISSUE_WARNING] += all.left_out[ISSUE_WARNING];
    issue_list_free(&all);
    return ok;
}
