/* What a field holds, and what was found in its place, in words. */
#include "app/planner/store/fields.h"
#include <math.h>
#include <stdio.h>

const char *fields_kind_words(const field *r)
{
    switch (r->kind) {
    case FIELD_VERSION: return "the number 1";
    case FIELD_NUMBER: return "a number";
    case FIELD_COUNT: return "a whole number";
    case FIELD_VEC3: return "three numbers [x, y, z]";
    case FIELD_RANGE: return "two numbers [low, high]";
    case FIELD_WORD: return "one of";
    case FIELD_TEXT: return "a text";
    case FIELD_FILE: return "the name of a file";
    case FIELD_OTHER: return r->words;
    }
    return "";
}

const char *fields_range_words(const field *r, char *words, size_t size)
{
    const char *unit = r->unit ? r->unit : "", *gap = *unit ? " " : "";
    const char *below = r->high_open ? "less than" : "at most", *above = r->low_open ? "more than" : "at least";
    if (isinf(r->low) && isinf(r->high))
        snprintf(words, size, "any%s%s%s", gap, unit, r->kind == FIELD_RANGE ? ", null for an open end" : "");
    else if (isinf(r->high))
        snprintf(words, size, "%s %g%s%s", above, r->low, gap, unit);
    else if (isinf(r->low))
        snprintf(words, size, "%s %g%s%s", below, r->high, gap, unit);
    else
        snprintf(words, size, "%s %g and %s %g%s%s", above, r->low, below, r->high, gap, unit);
    return words;
}

const char *fields_value_words(const json_t *value, char *words, size_t size)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT: snprintf(words, size, "an object"); break;
    case JSON_ARRAY: snprintf(words, size, "a list of %zu", json_array_size(value)); break;
    case JSON_STRING: snprintf(words, size, "\"%.60s\"", json_string_value(value)); break;
    case JSON_INTEGER: snprintf(words, size, "%lld", (long long)json_integer_value(value)); break;
    case JSON_REAL: snprintf(words, size, "%.10g", json_real_value(value)); break;
    case JSON_TRUE: snprintf(words, size, "true"); break;
    case JSON_FALSE: snprintf(words, size, "false"); break;
    case JSON_NULL: snprintf(words, size, "null"); break;
    }
    return words;
}
