#include "app/planner/store/json_table.h"

static void print_quoted(const char *text, FILE *out)
{
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"') fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void print_value(const json_t *value, FILE *out)
{
    if (json_is_real(value))
        fprintf(out, "%.10g", json_real_value(value));
    else if (json_is_integer(value))
        fprintf(out, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_boolean(value))
        fputc(json_is_true(value) ? '1' : '0', out);
    else if (json_is_string(value))
        print_quoted(json_string_value(value), out);
}

void json_table_csv(const json_t *rows, FILE *out)
{
    size_t i;
    json_t *row, *value;
    const char *key, *comma = "";
    json_object_foreach(json_array_get(rows, 0), key, value)
    {
        fprintf(out, "%s%s", comma, key);
        comma = ",";
    }
    fputc('\n', out);
    json_array_foreach((json_t *)rows, i, row)
    {
        comma = "";
        json_object_foreach(row, key, value)
        {
            fputs(comma, out);
            print_value(value, out);
            comma = ",";
        }
        fputc('\n', out);
    }
}
