#include "app/planner/store/record.h"
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 128 };

/* {"type": word}, or with "null" besides. */
static json_t *of_type(const char *word, bool or_null)
{
    return or_null ? json_pack("{s[ss]}", "type", word, "null") : json_pack("{ss}", "type", word);
}

static json_t *text_schema(const record_row *r, bool or_null)
{
    char word[NAME_SIZE];
    if (!r->words) return of_type("string", or_null);
    json_t *list = json_array();
    for (int i = 0; record_word(r, i, word); i++) json_array_append_new(list, json_string(word));
    if (or_null) json_array_append_new(list, json_null());
    return json_pack("{so}", "enum", list);
}

static json_t *object_schema(const record_table *t, const char *base);

static json_t *value_schema(const record_row *r, record_kind kind, bool or_null)
{
    json_t *o;
    switch (kind) {
    case RECORD_NUMBER: return of_type("number", or_null || !r->optional);
    case RECORD_COUNT:
    case RECORD_LONG: return of_type("integer", or_null);
    case RECORD_BOOL: return of_type("boolean", or_null);
    case RECORD_TEXT:
    case RECORD_CHARS:
    case RECORD_WORD: return text_schema(r, or_null);
    case RECORD_NUMBERS:
        o = of_type("array", or_null);
        json_object_set_new(o, "items", of_type("number", true));
        json_object_set_new(o, "minItems", json_integer(r->length));
        json_object_set_new(o, "maxItems", json_integer(r->length));
        return o;
    case RECORD_OBJECT:
    case RECORD_JSON:
        o = object_schema(r->table, "");
        if (or_null) json_object_set_new(o, "type", json_pack("[ss]", "object", "null"));
        return o;
    case RECORD_LIST:
        o = of_type("array", or_null);
        json_object_set_new(o, "items", value_schema(r, r->item, false));
        return o;
    case RECORD_MAP:
        o = of_type("object", or_null);
        json_object_set_new(o, "additionalProperties", value_schema(r, r->item, false));
        return o;
    }
    return NULL;
}

static json_t *row_schema(const record_row *r)
{
    json_t *o = value_schema(r, r->kind, r->or_null);
    char words[512];
    snprintf(words, sizeof words, "%s%s%s", r->help, r->unit ? ", " : "", r->unit ? r->unit : "");
    json_object_set_new(o, "description", json_string(words));
    return o;
}

static bool always_there(const record_row *r) { return !r->optional && !r->when; }

/* The rows whose names begin with `base`, as an object. A group of dotted names is there where one of them is. */
static json_t *object_schema(const record_table *t, const char *base)
{
    json_t *properties = json_object(), *required = json_array();
    size_t skip = strlen(base);
    for (int i = 0; i < t->count; i++) {
        const record_row *r = &t->row[i];
        char name[NAME_SIZE], within[2 * NAME_SIZE];
        if (strncmp(r->name, base, skip)) continue;
        size_t n = strcspn(r->name + skip, ".");
        bool leaf = !r->name[skip + n], needed = false;
        snprintf(name, sizeof name, "%.*s", (int)n, r->name + skip);
        if (json_object_get(properties, name)) continue;
        snprintf(within, sizeof within, "%s%s.", base, name);
        for (int k = 0; k < t->count; k++)
            needed |= always_there(&t->row[k]) && (leaf ? k == i : !strncmp(t->row[k].name, within, strlen(within)));
        json_object_set_new(properties, name, leaf ? row_schema(r) : object_schema(t, within));
        if (needed) json_array_append_new(required, json_string(name));
    }
    return json_pack("{ss so so sb}", "type", "object", "properties", properties, "required", required,
                     "additionalProperties", false);
}

json_t *record_schema(const record_table *t)
{
    json_t *o = json_pack("{ss ss}", "$schema", "https://json-schema.org/draft/2020-12/schema", "title", t->title);
    json_t *body = object_schema(t, ""), *required = json_object_get(body, "required");
    json_t *own = json_pack("{s{si ss} s{ss ss} s{ss ss}}", "gnathos", "const", RECORD_FORMAT, "description",
                            "number of the format", "kind", "const", t->kind, "description", "which record this is",
                            "version", "type", "string", "description", "of the program that wrote it");
    const char *name;
    json_t *one;
    int at = 0;
    json_object_foreach(own, name, one) json_array_insert_new(required, (size_t)at++, json_string(name));
    json_object_update(own, json_object_get(body, "properties"));
    json_object_set_new(body, "properties", own);
    json_object_update(o, body);
    json_decref(body);
    return o;
}
