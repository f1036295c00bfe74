#include "app/cli/fields_help.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_default(const field *r, const void *defaults)
{
    const char *at = (const char *)defaults + r->offset;
    double v[3] = {0};
    int word;
    char text[64];
    switch (r->kind) {
    case FIELD_NUMBER:
        memcpy(v, at, sizeof v[0]);
        printf("default %g", v[0]);
        break;
    case FIELD_VEC3:
        memcpy(v, at, sizeof v);
        printf("default [%g, %g, %g]", v[0], v[1], v[2]);
        break;
    case FIELD_RANGE:
        memcpy(v, at, 2 * sizeof v[0]);
        printf("default [");
        for (int i = 0; i < 2; i++)
            if (isinf(v[i]))
                printf("null%s", i ? "]" : ", ");
            else
                printf("%g%s", v[i], i ? "]" : ", ");
        break;
    case FIELD_COUNT:
        memcpy(&word, at, sizeof word);
        printf("default %d", word);
        break;
    case FIELD_WORD:
        memcpy(&word, at, sizeof word);
        printf("default %s", fields_word(r, word, text, sizeof text));
        break;
    default: printf("optional");
    }
}

void fields_help(const field_table *t)
{
    printf("%s\n", t->title);
    for (int i = 0; i < t->count; i++) {
        const field *r = &t->row[i];
        char range[128];
        printf("\n  %s\n      %s%s%s", r->name, fields_kind_words(r), r->kind == FIELD_WORD ? ": " : "",
               r->kind == FIELD_WORD ? r->words : "");
        bool numeric =
            r->kind == FIELD_NUMBER || r->kind == FIELD_COUNT || r->kind == FIELD_VEC3 || r->kind == FIELD_RANGE;
        if (numeric) printf(", %s", fields_range_words(r, range, sizeof range));
        printf("; ");
        if (r->required)
            printf("required");
        else if (t->defaults)
            print_default(r, t->defaults);
        else
            printf("optional");
        printf("\n      %s\n", r->help);
    }
    printf("\nA field whose name begins with // is a comment.\n");
}
