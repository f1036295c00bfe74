/* jansson gives no positions of parsed values, so a place is found, only when a message needs it, by walking
 * the text again along the pointer. The text was parsed before, so the walk can rely on its syntax. */
#include "geometry/json_file.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void json_file_free(json_file *f)
{
    free(f->path);
    free(f->text);
    json_decref(f->root);
    *f = (json_file){0};
}

bool json_file_parse(const char *text, size_t size, const char *path, json_file *out, err *e)
{
    bool marked;
    if (!input_text_mark(text, size, path, &marked, e)) return false;
    if (marked) { /* as some editors write it */
        text += 3;
        size -= 3;
    }
    size_t blank = 0;
    while (blank < size && memchr(" \t\r\n", text[blank], 4)) blank++;
    if (blank == size) return err_at(e, ERR_INPUT, path, 0, NULL, "the file is empty");
    if (memchr(text, 0, size)) return err_at(e, ERR_INPUT, path, 0, NULL, "a binary file, not JSON");
    json_error_t why;
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &why);
    if (!root)
        return err_at(e, ERR_INPUT, path, why.line, NULL, "not valid JSON: %s (column %d)", why.text, why.column);
    *out = (json_file){.path = mem_text(path), .text = mem_alloc(size + 1, 1), .root = root};
    memcpy(out->text, text, size);
    return true;
}

bool json_file_read(const char *path, json_file *out, err *e)
{
    char *text;
    size_t size;
    if (!input_file_load(path, INPUT_TEXT_BYTES, &text, &size, e)) return false;
    bool ok = json_file_parse(text, size, path, out, e);
    free(text);
    return ok;
}

static const char *skip_blank(const char *p) { return p + strspn(p, " \t\r\n"); }

static const char *skip_string(const char *p) /* at the opening quote */
{
    for (p++; *p && *p != '"'; p++)
        if (*p == '\\' && p[1]) p++;
    return *p ? p + 1 : p;
}

static const char *skip_value(const char *p)
{
    int depth = 0;
    do {
        if (*p == '"') {
            p = skip_string(p);
            continue;
        }
        if (*p == '{' || *p == '[') depth++;
        if (*p == '}' || *p == ']') depth--;
        size_t plain = strcspn(p, "\"{}[], \t\r\n:");
        p += plain ? plain : 1;
    } while (*p && depth > 0);
    return p;
}

/* One reference token of a pointer, ~1 and ~0 undone; returns the rest of the pointer. */
static const char *next_token(const char *pointer, char *token, size_t size)
{
    size_t n = 0;
    for (pointer += *pointer == '/'; *pointer && *pointer != '/'; pointer++) {
        char c = *pointer;
        if (c == '~' && (pointer[1] == '0' || pointer[1] == '1')) c = *++pointer == '0' ? '~' : '/';
        if (n + 1 < size) token[n++] = c;
    }
    token[n] = 0;
    return pointer;
}

static bool key_is(const char *quoted, const char *end, const char *token)
{
    size_t n = (size_t)(end - quoted);
    if (!memchr(quoted, '\\', n)) return strlen(token) == n - 2 && !memcmp(quoted + 1, token, n - 2);
    json_t *key = json_loadb(quoted, n, JSON_DECODE_ANY, NULL);
    bool same = key && !strcmp(json_string_value(key), token);
    json_decref(key);
    return same;
}

/* Where the member or element `token` of the value at p begins: *place for people (its key), the return value
 * for the walk (its value). NULL if there is none. */
static const char *step_into(const char *p, const char *token, const char **place)
{
    bool object = *p == '{';
    if (!object && *p != '[') return NULL;
    char *end;
    long index = strtol(token, &end, 10);
    if (!object && (end == token || *end)) return NULL;
    p = skip_blank(p + 1);
    for (long i = 0; *p && *p != '}' && *p != ']'; i++) {
        const char *start = p;
        bool found = !object && i == index;
        if (object) {
            const char *key_end = skip_string(p);
            found = key_is(p, key_end, token);
            p = skip_blank(skip_blank(key_end) + 1);
        }
        if (found) {
            *place = start;
            return p;
        }
        p = skip_blank(skip_value(p));
        if (*p == ',') p = skip_blank(p + 1);
    }
    return NULL;
}

int json_file_line(const json_file *f, const char *pointer)
{
    char token[256];
    const char *p = skip_blank(f->text), *place = p;
    while (p && *pointer) {
        pointer = next_token(pointer, token, sizeof token);
        p = step_into(p, token, &place);
    }
    int line = 1;
    for (const char *c = f->text; c < place; c++) line += *c == '\n';
    return line;
}

void json_file_field(const json_file *f, const char *pointer, char *field, size_t size)
{
    char token[256];
    size_t n = 0;
    const json_t *value = f->root;
    field[0] = 0;
    while (*pointer && n < size) {
        pointer = next_token(pointer, token, sizeof token);
        bool element = json_is_array(value);
        int wrote = element ? snprintf(field + n, size - n, "[%s]", token)
                            : snprintf(field + n, size - n, "%s%s", n ? "." : "", token);
        value = element ? json_array_get(value, strtoul(token, NULL, 10)) : json_object_get(value, token);
        if (wrote > 0) n += (size_t)wrote;
    }
}

bool json_file_refuse(const json_file *f, const char *pointer, err *e, const char *fmt, ...)
{
    char field[256], text[768];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    json_file_field(f, pointer, field, sizeof field);
    return err_at(e, ERR_INPUT, f->path, json_file_line(f, pointer), *field ? field : NULL, "%s", text);
}

bool json_file_vec3(const json_file *f, const json_t *value, const char *pointer, double out[3], err *e)
{
    if (!json_is_array(value) || json_array_size(value) != 3)
        return json_file_refuse(f, pointer, e, "must be three numbers [x, y, z]");
    double v[3];
    for (size_t i = 0; i < 3; i++) {
        const json_t *c = json_array_get(value, i);
        if (!json_is_number(c)) return json_file_refuse(f, pointer, e, "must be three numbers [x, y, z]");
        v[i] = json_number_value(c);
    }
    memcpy(out, v, sizeof v);
    return true;
}

bool json_file_write(const json_t *root, const char *path, err *e)
{
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    if (json_dumpf(root, w.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) && !ferror(w.stream)) {
        whole_file_abandon(&w);
        return err_at(e, ERR_INTERNAL, path, 0, NULL, "cannot be put into JSON");
    }
    fputc('\n', w.stream); /* a write that failed stays marked on the stream; whole_file_close finds it */
    return whole_file_close(&w, e);
}
