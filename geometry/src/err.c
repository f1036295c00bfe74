#include "geometry/err.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Bytes of a control character at c: C0 and DEL 1, C1 in UTF-8 2, else 0. */
static size_t control_bytes(const unsigned char *c)
{
    if (*c < 0x20 || *c == 0x7F) return 1;
    return c[0] == 0xC2 && c[1] >= 0x80 && c[1] <= 0x9F ? 2 : 0;
}

void err_printable(char *text, size_t size)
{
    static const char digit[] = "0123456789abcdef";
    for (char *c = text; *c;) {
        size_t count = control_bytes((unsigned char *)c);
        if (!count) {
            c++;
            continue;
        }
        unsigned char byte[2] = {(unsigned char)c[0], (unsigned char)c[1]};
        size_t rest = strlen(c + count), used = (size_t)(c - text) + 4 * count, room = size - 1;
        if (used > room) {
            *c = 0;
            return;
        }
        if (rest > room - used) rest = room - used;
        memmove(c + 4 * count, c + count, rest);
        c[4 * count + rest] = 0;
        for (size_t i = 0; i < count; i++) {
            *c++ = '\\';
            *c++ = 'x';
            *c++ = digit[byte[i] >> 4];
            *c++ = digit[byte[i] & 15];
        }
    }
}

bool err_set(err *e, err_code code, const char *fmt, ...)
{
    if (e->code != ERR_NONE) return false;
    e->code = code;
    va_list args;
    va_start(args, fmt);
    vsnprintf(e->text, sizeof e->text, fmt, args);
    va_end(args);
    err_printable(e->text, sizeof e->text);
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
    err_printable(e->text, sizeof e->text);
    return false;
}
