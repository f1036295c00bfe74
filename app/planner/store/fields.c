#include "app/planner/store/fields.h"
#include "geometry/suggest.h"
#include "geometry/mem.h"
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { POINTER_SIZE = 256, NAMES_MAX = 128 };

void fields_issue(const json_file *f, const char *pointer, issue_list *issues, const char *fmt, ...)
{
    char name[POINTER_SIZE], text[1024];
    if (issue_leave_out(issues, ISSUE_ERROR)) return; /* before its line is looked for */
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    json_file_field(f, pointer, name, sizeof name);
    issue_add(issues, ISSUE_ERROR, ERR_INPUT, f->path, json_file_line(f, pointer), name, "%s", text);
}

static bool in_range(const field *r, double v)
{
    return (r->low_open ? v > r->low : v >= r->low) && (r->high_open ? v < r->high : v <= r->high);
}

static void wrong_kind(const field *r, const json_file *f, const json_t *v, const char *pointer, issue_list *issues)
{
    char got[96];
    fields_issue(f, pointer, issues, "is %s; must be %s%s%s", fields_value_words(v, got, sizeof got),
                 fields_kind_words(r), r->unit ? " in " : "", r->unit ? r->unit : "");
}

static bool read_number(const field *r, const json_file *f, const json_t *v, const char *pointer, double *out,
                        issue_list *issues)
{
    if (!json_is_number(v) || (r->kind == FIELD_COUNT && !json_is_integer(v))) {
        wrong_kind(r, f, v, pointer, issues);
        return false;
    }
    char got[96], range[128];
    *out = json_number_value(v);
    if (in_range(r, *out)) return true;
    fields_issue(f, pointer, issues, "is %s; must be %s", fields_value_words(v, got, sizeof got),
                 fields_range_words(r, range, sizeof range));
    return false;
}

static void read_numbers(const field *r, const json_file *f, const json_t *v, const char *pointer, double *target,
                         issue_list *issues)
{
    size_t want = r->kind == FIELD_VEC3 ? 3 : 2;
    double out[3];
    char element[POINTER_SIZE + 32];
    if (!json_is_array(v) || json_array_size(v) != want) {
        wrong_kind(r, f, v, pointer, issues);
        return;
    }
    field one = *r;
    one.kind = FIELD_NUMBER;
    for (size_t i = 0; i < want; i++) {
        snprintf(element, sizeof element, "%s/%zu", pointer, i);
        const json_t *number = json_array_get(v, i);
        double end = i ? r->high : r->low;
        if (r->kind == FIELD_RANGE && isinf(end) && json_is_null(number))
            out[i] = end;
        else if (!read_number(&one, f, number, element, &out[i], issues))
            return;
    }
    if (r->kind == FIELD_RANGE && out[0] > out[1])
        fields_issue(f, pointer, issues, "is [%g, %g]; the first number must be the smaller one", out[0], out[1]);
    else
        memcpy(target, out, want * sizeof *out);
}

static int split_words(const char *words, char *copy, size_t size, const char **names)
{
    int n = 0;
    snprintf(copy, size, "%s", words);
    for (char *save, *w = strtok_r(copy, " ", &save); w && n < NAMES_MAX; w = strtok_r(NULL, " ", &save))
        names[n++] = w;
    return n;
}

const char *fields_word(const field *r, int number, char *word, size_t size)
{
    char copy[256];
    const char *names[NAMES_MAX];
    int count = split_words(r->words, copy, sizeof copy, names);
    snprintf(word, size, "%s", number >= 0 && number < count ? names[number] : "");
    return word;
}

static void read_word(const field *r, const json_file *f, const json_t *v, const char *pointer, int *target,
                      issue_list *issues)
{
    char copy[256], got[96];
    const char *names[NAMES_MAX], *text = json_string_value(v);
    int n = split_words(r->words, copy, sizeof copy, names);
    for (int i = 0; text && i < n; i++) {
        if (strcmp(names[i], text)) continue;
        *target = i;
        return;
    }
    fields_issue(f, pointer, issues, "is %s; must be one of: %s", fields_value_words(v, got, sizeof got), r->words);
}

static void read_file(const json_file *f, const json_t *v, const char *pointer, char *target, issue_list *issues)
{
    const char *name = json_string_value(v), *slash = strrchr(f->path, '/');
    int folder = slash && *name != '/' ? (int)(slash - f->path) + 1 : 0;
    char path[FIELD_PATH_SIZE];
    struct stat info;
    int n = snprintf(path, sizeof path, "%.*s%s", folder, f->path, name);
    if (n < 0 || n >= FIELD_PATH_SIZE)
        fields_issue(f, pointer, issues, "is a path of %d bytes; at most %d are read", n, FIELD_PATH_SIZE - 1);
    else if (!*name)
        fields_issue(f, pointer, issues, "is empty; must be the name of a file");
    else if (stat(path, &info))
        fields_issue(f, pointer, issues, "%s: %s", path, strerror(errno));
    else if (S_ISDIR(info.st_mode))
        fields_issue(f, pointer, issues, "%s is a folder; must be a file", path);
    else if (!S_ISREG(info.st_mode))
        fields_issue(f, pointer, issues, "%s is not a regular file", path);
    else if (access(path, R_OK))
        fields_issue(f, pointer, issues, "%s: %s", path, strerror(errno));
    else
        strcpy(target, path);
}

static void read_row(const field *r, const json_file *f, const json_t *v, const char *pointer, void *target,
                     issue_list *issues)
{
    char *at = (char *)target + r->offset;
    double number;
    switch (r->kind) {
    case FIELD_OTHER: break;
    case FIELD_VERSION:
        if (!json_is_integer(v))
            wrong_kind(r, f, v, pointer, issues);
        else if (json_integer_value(v) != 1)
            fields_issue(f, pointer, issues, "version %lld is not known; this gnathos (%s) reads version 1",
                         (long long)json_integer_value(v), GNATHOS_VERSION);
        else
            memcpy(at, &(int){1}, sizeof(int));
        break;
    case FIELD_NUMBER:
        if (read_number(r, f, v, pointer, &number, issues)) memcpy(at, &number, sizeof number);
        break;
    case FIELD_COUNT:
        if (read_number(r, f, v, pointer, &number, issues)) memcpy(at, &(int){(int)number}, sizeof(int));
        break;
    case FIELD_VEC3:
    case FIELD_RANGE: read_numbers(r, f, v, pointer, (double *)(void *)at, issues); break;
    case FIELD_WORD: read_word(r, f, v, pointer, (int *)(void *)at, issues); break;
    case FIELD_TEXT:
        if (!json_is_string(v))
            wrong_kind(r, f, v, pointer, issues);
        else if (json_string_length(v) >= FIELD_TEXT_SIZE)
            fields_issue(f, pointer, issues, "has %zu bytes; at most %d are kept", json_string_length(v),
                         FIELD_TEXT_SIZE - 1);
        else
            err_printable(strcpy(at, json_string_value(v)), FIELD_TEXT_SIZE);
        break;
    case FIELD_FILE:
        if (!json_is_string(v))
            wrong_kind(r, f, v, pointer, issues);
        else
            read_file(f, v, pointer, at, issues);
        break;
    }
}

/* Names that may stand in the object called `base` ("" or "tissue."), each once. */
static int names_within(const field_table *t, const char *base, char (*name)[64], const char **list)
{
    int n = 0;
    size_t skip = strlen(base);
    for (int i = 0; i < t->count && n < NAMES_MAX; i++) {
        if (strncmp(t->row[i].name, base, skip)) continue;
        snprintf(name[n], sizeof name[n], "%.*s", (int)strcspn(t->row[i].name + skip, "."), t->row[i].name + skip);
        bool known = false;
        for (int k = 0; k < n && !known; k++) known = !strcmp(name[k], name[n]);
        if (known) continue;
        list[n] = name[n];
        n++;
    }
    return n;
}

static void unknown(const field_table *t, const char *base, const char *key, const json_t *value, const json_file *f,
                    const char *pointer, issue_list *issues)
{
    char name[NAMES_MAX][64], all[768] = "";
    const char *list[NAMES_MAX];
    if (issue_leave_out(issues, ISSUE_ERROR)) return; /* before the search for names that are like it */
    if (t->hint && t->hint(key, value, all, sizeof all)) {
        fields_issue(f, pointer, issues, "unknown field; %s", all);
        return;
    }
    all[0] = 0;
    int n = names_within(t, base, name, list), near = suggest_nearest(key, list, n);
    if (near >= 0) {
        fields_issue(f, pointer, issues, "unknown field; did you mean \"%s\"?", list[near]);
        return;
    }
    for (int i = 0; i < t->count; i++) { /* the right name in the wrong object */
        const char *dot = strrchr(t->row[i].name, '.'), *last = dot ? dot + 1 : t->row[i].name;
        if (strcmp(last, key)) continue;
        fields_issue(f, pointer, issues, "unknown field here; its place is %s", t->row[i].name);
        return;
    }
    for (int i = 0; i < n; i++) {
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", list[i]);
    }
    fields_issue(f, pointer, issues, "unknown field; known here: %s", all);
}

static bool is_comment(const char *key) { return key[0] == '/' && key[1] == '/'; }

static void read_object(const field_table *t, const json_file *f, const json_t *o, const char *base,
                        const char *pointer, void *target, issue_list *issues)
{
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)o, key, value)
    {
        if (is_comment(key)) continue;
        char full[POINTER_SIZE], place[POINTER_SIZE];
        snprintf(full, sizeof full, "%s%s", base, key);
        int n = snprintf(place, sizeof place, "%s/", pointer);
        for (const char *c = key; *c && n + 3 < POINTER_SIZE; c++)
            if (*c == '~' || *c == '/')
                n += snprintf(place + n, sizeof place - (size_t)n, *c == '~' ? "~0" : "~1");
            else
                place[n++] = *c;
        place[n] = 0;
        const field *row = NULL;
        bool object = false;
        size_t length = strlen(full);
        for (int i = 0; i < t->count; i++) {
            if (!strcmp(t->row[i].name, full)) row = &t->row[i];
            if (!strncmp(t->row[i].name, full, length) && t->row[i].name[length] == '.') object = true;
        }
        if (row) {
            read_row(row, f, value, place, target, issues);
        } else if (object && json_is_object(value)) {
            snprintf(full + length, sizeof full - length, ".");
            read_object(t, f, value, full, place, target, issues);
        } else if (object) {
            char got[96];
            fields_issue(f, place, issues, "is %s; must be an object { ... }",
                         fields_value_words(value, got, sizeof got));
        } else {
            unknown(t, base, key, value, f, place, issues);
        }
    }
}

static const json_t *find(const json_t *o, const char *name)
{
    char part[64];
    while (o && *name) {
        size_t n = strcspn(name, ".");
        snprintf(part, sizeof part, "%.*s", (int)n, name);
        o = json_object_get(o, part);
        name += n + (name[n] == '.');
    }
    return o;
}

void fields_read(const field_table *t, const json_file *f, const json_t *o, const char *pointer, void *target,
                 issue_list *issues)
{
    int from = issues->count;
    read_object(t, f, o, "", pointer, target, issues);
    for (int i = 0; i < t->count; i++) {
        const field *r = &t->row[i];
        if (!r->required || find(o, r->name)) continue;
        char place[POINTER_SIZE];
        snprintf(place, sizeof place, "%s/%s", pointer, r->name);
        for (char *c = place + strlen(pointer); *c; c++)
            if (*c == '.') *c = '/';
        fields_issue(f, place, issues, "is missing; must be %s", fields_kind_words(r));
    }
    issue_sort_by_line(issues, from);
}
