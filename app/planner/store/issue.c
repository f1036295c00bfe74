#include "app/planner/store/issue.h"
#include "geometry/mem.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append(issue_list *l, issue one)
{
    l->kept[one.level]++;
    l->item = GROW_ARRAY(issue, l->item, l->count + 1);
    l->item[l->count++] = one;
}

bool issue_leave_out(issue_list *l, issue_level level)
{
    bool full = l->kept[level] >= ISSUES_MOST;
    l->left_out[level] += full;
    return full;
}

static char *printable(const char *text)
{
    size_t size = 4 * strlen(text) + 1;
    char *own = mem_alloc(size, 1);
    memcpy(own, text, strlen(text));
    err_printable(own, size);
    return own;
}

static char *copy_or_null(const char *text) { return text && *text ? printable(text) : NULL; }

void issue_add(issue_list *l, issue_level level, err_code code, const char *file, int line, const char *field,
               const char *fmt, ...)
{
    char text[1024];
    va_list args;
    if (issue_leave_out(l, level)) return;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    append(l, (issue){.level = level,
                      .code = code,
                      .line = line,
                      .file = copy_or_null(file),
                      .field = copy_or_null(field),
                      .text = printable(text)});
}

void issue_add_err(issue_list *l, issue_level level, const err *e, const char *file)
{
    const char *text = e->text;
    if (issue_leave_out(l, level)) return;
    char *shown = copy_or_null(file); /* as the err has it */
    size_t n = shown ? strlen(shown) : 0;
    int line = 0;
    if (n && !strncmp(text, shown, n) && text[n] == ':') {
        text += n + 1;
        char *end;
        long number = strtol(text, &end, 10);
        if (end > text && *end == ':' && number > 0) {
            line = (int)number;
            text = end + 1;
        }
        text += strspn(text, " ");
    }
    append(l, (issue){.level = level, .code = e->code, .line = line, .file = shown, .text = printable(text)});
}

void issue_sort_by_line(issue_list *l, int from)
{
    for (int i = from + 1; i < l->count; i++) {
        issue one = l->item[i];
        int k = i;
        for (; k > from && l->item[k - 1].line > one.line; k--) l->item[k] = l->item[k - 1];
        l->item[k] = one;
    }
}

int issue_count(const issue_list *l, issue_level level) { return l->kept[level] + l->left_out[level]; }

bool issue_none_is_error(const issue_list *l, err *e)
{
    for (int i = 0; i < l->count; i++) {
        const issue *one = &l->item[i];
        if (one->level == ISSUE_ERROR) return err_at(e, one->code, one->file, one->line, one->field, "%s", one->text);
    }
    return true;
}

void issue_list_free(issue_list *l)
{
    for (int i = 0; i < l->count; i++) {
        free(l->item[i].file);
        free(l->item[i].field);
        free(l->item[i].text);
    }
    free(l->item);
    *l = (issue_list){0};
}

const char *issue_level_name(issue_level level)
{
    static const char *const names[] = {"error", "warning", "info"};
    return names[level];
}
