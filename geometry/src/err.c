#include "geometry/err.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void one_line(char *text)
{
    for (char *c = text; *c; c++)
        if (*c == '\n' || *c == '\r') *c = ' ';
}

bool err_set(err *e, err_code code, const char *fmt, ...)
{
    if (e->code != ERR_NONE) return false;
    e->code = code;
    va_list args;
    va_start(args, fmt);
    vsnprintf(e->text, sizeof e->text, fmt, args);
    va_end(args);
    one_line(e->text);
    return false;
}

bool err_at(err *e, err_code code, const char *path, int line, const char *field, const char *fmt, ...)
{
    if (e->code != ERR_NONE) return false;
    char text[sizeof e->text];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    char place[640] = "";
    int n = 0;
    if (path && line > 0)
        n = snprintf(place, sizeof place, "%s:%d: ", path, line);
    else if (path)
        n = snprintf(place, sizeof place, "%s: ", path);
    if (field && n >= 0 && (size_t)n < sizeof place) snprintf(place + n, sizeof place - (size_t)n, "%s: ", field);
    return err_set(e, code, "%s%s", place, text);
}

bool err_prefix(err *e, const char *fmt, ...)
{
    char text[sizeof e->text], prefix[256];
    memcpy(text, e->text, sizeof text);
    va_list args;
    va_start(args, fmt);
    vsnprintf(prefix, sizeof prefix, fmt, args);
    va_end(args);
    int n = snprintf(e->text, sizeof e->text, "%s: %s", prefix, text);
    if (n < 0) e->text[0] = 0;
    one_line(e->text);
    return false;
}
