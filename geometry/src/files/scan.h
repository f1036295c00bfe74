/* scan: words and numbers of a text in memory, one after another. Private. The text ends with a byte 0 at `end`. */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct scan {
    const char *start, *at, *end;
    char comment; /* from it on the rest of a line is skipped; 0: none */
} scan;

static inline bool scan_is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static inline void scan_skip_line(scan *s)
{
    const char *next = memchr(s->at, '\n', (size_t)(s->end - s->at));
    s->at = next ? next + 1 : s->end;
}

/* To the next word; false at the end. */
static inline bool scan_skip_blank(scan *s)
{
    while (s->at < s->end) {
        if (s->comment && *s->at == s->comment)
            scan_skip_line(s);
        else if (scan_is_blank(*s->at))
            s->at++;
        else
            return true;
    }
    return false;
}

/* The next word, cut off to fit; false at the end. */
static inline bool scan_word(scan *s, char *word, size_t size)
{
    if (!scan_skip_blank(s)) return false;
    const char *from = s->at;
    while (s->at < s->end && !scan_is_blank(*s->at)) s->at++;
    size_t n = (size_t)(s->at - from);
    if (n >= size) n = size - 1;
    memcpy(word, from, n);
    word[n] = 0;
    return true;
}

/* The next word, which must be a number (which may be "nan"). */
static inline bool scan_number(scan *s, double *out)
{
    char *end;
    if (!scan_skip_blank(s)) return false;
    *out = strtod(s->at, &end);
    if (end == s->at || (end < s->end && !scan_is_blank(*end) && !(s->comment && *end == s->comment))) return false;
    s->at = end;
    return true;
}

/* The next word, which must be a whole number from 0 to most. */
static inline bool scan_count(scan *s, long long most, long long *out)
{
    double number;
    if (!scan_number(s, &number) || !(number >= 0 && number <= (double)most)) return false;
    *out = (long long)number;
    return (double)*out == number;
}

/* Line, from 1, of the place reached. */
static inline int scan_line(const scan *s)
{
    int line = 1;
    for (const char *c = s->start; c < s->at; c++) line += *c == '\n';
    return line;
}
