/* fields: one table per kind of input file says which fields there are. It drives reading, checking and the
 * help text, so the three cannot differ. The default of a field is the value it has in the table's
 * `defaults`, a struct of the kind that is read. */
#pragma once
#include "app/planner/store/issue.h"
#include "geometry/json_file.h"

enum { FIELD_PATH_SIZE = 1024, FIELD_TEXT_SIZE = 256 };

typedef enum field_kind {
    FIELD_VERSION, /* int: the number 1, the format's version */
    FIELD_NUMBER,  /* double */
    FIELD_COUNT,   /* int */
    FIELD_VEC3,    /* double[3], each in the range */
    FIELD_RANGE,   /* double[2], low <= high, each in the range; null is an infinite end where the range has one */
    FIELD_WORD,    /* int: number of the word in `words` */
    FIELD_TEXT,    /* char[FIELD_TEXT_SIZE] */
    FIELD_FILE,    /* char[FIELD_PATH_SIZE]: an existing file, joined to the folder of the file that names it */
    FIELD_OTHER    /* read by code of its own; `words` says in the help what it holds */
} field_kind;

typedef struct field {
    const char *name; /* "tissue.element_mm"; objects need no rows of their own */
    field_kind kind;
    size_t offset; /* into the struct */
    const char *unit, *words;
    double low, high;
    bool low_open, high_open, required;
    const char *help; /* one sentence */
} field;

typedef struct field_table {
    const char *title;
    const field *row;
    int count;
    const void *defaults; /* NULL: the text of the help names no defaults */
    /* Where not NULL: says in `text` what is meant by the unknown field `key` that holds `value`; false if it does not
     * know. Asked before the nearest name is looked for. */
    bool (*hint)(const char *key, const json_t *value, char *text, size_t size);
} field_table;

/* For rows: FROM(0), ABOVE(0), TO(1), BELOW(1), and NUMBER(case_file, tissue.element_mm, "mm", ABOVE(0),
 * TO(20),
 * "...") where the field's name is also the member's. */
#define FROM(v) .low = (v)
#define ABOVE(v) .low = (v), .low_open = true
#define TO(v) .high = (v)
#define BELOW(v) .high = (v), .high_open = true
#define ANY FROM(-HUGE_VAL), TO(HUGE_VAL)
#define NUMBER(type, member, unit_, low_, high_, help_)                                                                \
    {                                                                                                                  \
        .name = #member, .kind = FIELD_NUMBER, .offset = offsetof(type, member), .unit = unit_, low_, high_,           \
        .help = help_                                                                                                  \
    }

/* Reads the object `o`, which stands at `pointer` in f, into target (already filled with defaults). Every
 * unknown, missing, mistyped or out-of-range field is one issue, in the order of lines; such a field keeps
 * its default. */
void fields_read(const field_table *t, const json_file *f, const json_t *o, const char *pointer, void *target,
                 issue_list *issues);
/* Adds an error with file, line and field of the value at the pointer. */
void fields_issue(const json_file *f, const char *pointer, issue_list *issues, const char *fmt, ...) PRINTF_LIKE(4, 5);
/* What the value is, in words, for messages: `"text"`, `12`, `a list`. */
const char *fields_value_words(const json_t *value, char *words, size_t size);
/* What a field holds and in which range, for messages and help: "a number", "more than 0 and at most 20 mm". */
const char *fields_kind_words(const field *r);
const char *fields_range_words(const field *r, char *words, size_t size);
/* The word of a FIELD_WORD by its number; "" where there is none. */
const char *fields_word(const field *r, int number, char *word, size_t size);
