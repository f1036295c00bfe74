#include "app/planner/store/issue.h"
#include "geometry/mem.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append(issue_list *l, issue one)
{
    l->item = GROW_ARRAY(issue, l->item, l->count + 1);
    l->item[l->count++] = one;
}

static char *copy_or_null(const char *text) { return text && *text ? mem_text(text) : NULL; }

void issue_add(issue_list *l, issue_level level, err_code code, const char *file, int line, const char *field,
               const char *fmt, ...)
{
    char text[1024];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    append(l, (issue){.level = level,
                      .code = code,
                      .line = line,
                      .file = copy_or_null(file),
                      .field = copy_or_null(field),
                      .text = mem_text(text)});
}

void issue_add_err(issue_list *l, issue_level level, const err *e, const char *file)
{
    const char *text = e->text;
    size_t n = file ? strlen(file) : 0;
    int line = 0;
    if (n && !strncmp(text, file, n) && text[n] == ':') {
        text += n + 1;
        char *end;
        long number = strtol(text, &end, 10);
        if (end > text && *end == ':' && number > 0) {
            line = (int)number;
            text = end + 1;
        }
        text += strspn(text, " ");
    }
    append(l,
           (issue){.level = level, .code = e->code, .line = line, .file = copy_or_null(file), .text = mem_text(text)});
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

int issue_count(const issue_list *l, issue_level level)
{
    int n = 0;
    for (int i = 0; i < l->count; i++) n += l->item[i].level == level;
    return n;
}

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
