#include "app/planner/store/record.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WORD_SIZE = 64 };

const char *record_word(const record_row *r, int n, char *word)
{
    const char *from = r->words;
    for (; from && n > 0; n--) {
        from = strchr(from, '|');
        if (from) from++;
    }
    if (!from) return NULL;
    snprintf(word, WORD_SIZE, "%.*s", (int)strcspn(from, "|"), from);
    return word;
}

static json_t *number(double x) { return isfinite(x) ? json_real(x) : NULL; }

static json_t *word(const record_row *r, int n)
{
    char text[WORD_SIZE];
    const char *found = n >= 0 ? record_word(r, n, text) : NULL;
    assert(found);
    return json_string(found);
}

static json_t *text(const record_row *r, const char *value)
{
    char one[WORD_SIZE];
    if (!value) return NULL;
    bool known = !r->words;
    for (int n = 0; !known && record_word(r, n, one); n++) known = !strcmp(one, value);
    assert(known);
    return json_string(value);
}

static json_t *numbers(const record_row *r, const void *at)
{
    json_t *list = json_array();
    for (int i = 0; i < r->length; i++) {
        double x;
        memcpy(&x, (const char *)at + (size_t)i * sizeof x, sizeof x);
        json_t *one = number(x);
        json_array_append_new(list, one ? one : json_null());
    }
    return list;
}

/* The value at its place; NULL: there is none. */
static json_t *value_at(const record_row *r, record_kind kind, const void *at)
{
    double x;
    int n;
    int64_t wide;
    bool yes;
    const char *string;
    json_t *json;
    switch (kind) {
    case RECORD_NUMBER: memcpy(&x, at, sizeof x); return number(x);
    case RECORD_COUNT: memcpy(&n, at, sizeof n); return json_integer(n);
    case RECORD_LONG: memcpy(&wide, at, sizeof wide); return json_integer(wide);
    case RECORD_BOOL: memcpy(&yes, at, sizeof yes); return json_boolean(yes);
    case RECORD_TEXT: memcpy(&string, at, sizeof string); return text(r, string);
    case RECORD_CHARS: return text(r, at);
    case RECORD_WORD: memcpy(&n, at, sizeof n); return word(r, n);
    case RECORD_NUMBERS: return numbers(r, at);
    case RECORD_OBJECT: return record_part(r->table, at);
    case RECORD_JSON: memcpy(&json, at, sizeof json); return json ? json_deep_copy(json) : NULL;
    case RECORD_LIST:
    case RECORD_MAP: break;
    }
    assert(!"lists and maps have no place");
    return NULL;
}

/* The item after those before *i. */
static const void *item(const record_row *r, const void *of, int *i, const char **key, void *space)
{
    int count;
    const void *first = (const char *)of + r->offset;
    if (r->pointer) memcpy(&first, first, sizeof first);
    if (r->next) return r->next(first, i, key, space);
    memcpy(&count, (const char *)of + r->count_at, sizeof count);
    return *i < count ? (const char *)first + (size_t)*i * r->stride : NULL;
}

static json_t *items(const record_row *r, const void *of)
{
    _Alignas(max_align_t) char space[RECORD_SPACE];
    json_t *all = r->kind == RECORD_LIST ? json_array() : json_object();
    const char *key = NULL;
    int i = 0;
    for (const void *one; (one = item(r, of, &i, &key, space)) != NULL; i++) {
        json_t *v = value_at(r, r->item, one);
        if (!v) v = json_null();
        if (r->kind == RECORD_LIST)
            json_array_append_new(all, v);
        else
            json_object_set_new(all, key, v);
    }
    return all;
}

static json_t *found_number(const record_row *r, double x)
{
    if (isnan(x)) return NULL;
    switch (r->kind) {
    case RECORD_NUMBER: return number(x);
    case RECORD_BOOL: return json_boolean(x != 0);
    case RECORD_WORD: return word(r, (int)x);
    default: return json_integer((json_int_t)x);
    }
}

static json_t *value_of(const record_row *r, const void *of)
{
    _Alignas(max_align_t) char space[RECORD_SPACE];
    const void *at = (const char *)of + r->offset;
    if (r->number) return found_number(r, r->number(of));
    if (r->text) return text(r, r->text(of, space));
    if (r->kind == RECORD_LIST || r->kind == RECORD_MAP) return items(r, of);
    if (r->at) at = r->at(of, space);
    if (r->pointer) memcpy(&at, at, sizeof at);
    return at ? value_at(r, r->kind, at) : NULL;
}

/* The object in which the last part of a dotted name stands; made where it is not there. */
static json_t *home(json_t *o, const char **name)
{
    for (const char *dot; (dot = strchr(*name, '.')) != NULL; *name = dot + 1) {
        char part[WORD_SIZE];
        snprintf(part, sizeof part, "%.*s", (int)(dot - *name), *name);
        json_t *next = json_object_get(o, part);
        if (!next) json_object_set_new(o, part, next = json_object());
        o = next;
    }
    return o;
}

static void write_rows(const record_table *t, const void *of, json_t *o)
{
    for (int i = 0; i < t->count; i++) {
        const record_row *r = &t->row[i];
        if (r->when && !r->when(of)) continue;
        json_t *v = value_of(r, of);
        if (!v && r->optional) continue;
        assert(v || r->or_null || r->kind == RECORD_NUMBER);
        const char *name = r->name;
        json_t *in = home(o, &name);
        json_object_set_new(in, name, v ? v : json_null());
    }
}

json_t *record_part(const record_table *t, const void *of)
{
    json_t *o = json_object();
    write_rows(t, of, o);
    return o;
}

json_t *record_json(const record_table *t, const void *of)
{
    assert(t->kind);
    json_t *o = json_pack("{si ss ss}", "gnathos", RECORD_FORMAT, "kind", t->kind, "version", GNATHOS_VERSION);
    write_rows(t, of, o);
    return o;
}

const char *record_kind_of(const json_t *record)
{
    const char *kind = json_string_value(json_object_get(record, "kind"));
    return kind ? kind : "";
}

bool record_check(const json_file *f, const char *kind, err *e)
{
    const json_t *format = json_object_get(f->root, "gnathos");
    const char *own = record_kind_of(f->root);
    if (json_is_integer(format) && json_integer_value(format) > RECORD_FORMAT)
        return json_file_refuse(f, "/gnathos", e, "version %lld is not known; this gnathos (%s) reads version %d",
                                (long long)json_integer_value(format), GNATHOS_VERSION, RECORD_FORMAT);
    if (!json_is_integer(format) || !*own)
        return json_file_refuse(f, "", e,
                                "is not a record of kind \"%s\": it lacks \"gnathos\" or \"kind\", as what an earlier "
                                "gnathos wrote does; make it again",
                                kind);
    if (json_integer_value(format) != RECORD_FORMAT)
        return json_file_refuse(f, "/gnathos", e, "is %lld; must be %d", (long long)json_integer_value(format),
                                RECORD_FORMAT);
    return !strcmp(own, kind) || json_file_refuse(f, "/kind", e, "is \"%s\"; must be \"%s\"", own, kind);
}
