/* record: one table per kind of output says which fields it has, as fields.h does for inputs. It drives writing, the
 * help text and the JSON schema, so the three cannot differ.
 *
 * Every record, in a file and on stdout, begins with "gnathos", the number of the format, which inputs have too,
 * "kind", the name of its table, and "version", of the program that wrote it. Its further fields are found by their
 * rows in a struct: at an offset, behind a pointer there, or by a function. */
#pragma once
#include "geometry/json_file.h"
#include <stddef.h>
#include <stdint.h>

enum { RECORD_FORMAT = 1, RECORD_SPACE = 1024 };

typedef enum record_kind {
    RECORD_NUMBER,  /* double; null where it is not finite */
    RECORD_COUNT,   /* int */
    RECORD_LONG,    /* int64_t */
    RECORD_BOOL,    /* bool */
    RECORD_TEXT,    /* const char *; one of `words`, where there are any */
    RECORD_CHARS,   /* char[], the same in place */
    RECORD_WORD,    /* an enum or int: number of the word in `words` */
    RECORD_NUMBERS, /* double[length] */
    RECORD_OBJECT,  /* a struct with `table` */
    RECORD_LIST,    /* of items: `next` finds them, or an array has them */
    RECORD_MAP,     /* of items that `next` finds, each with a name */
    RECORD_JSON     /* json_t *: written by `table` earlier */
} record_kind;

typedef struct record_table record_table;

typedef struct record_row {
    const char *name; /* "seconds.solve_wall"; objects around such fields need no rows of their own */
    record_kind kind;
    size_t offset;
    int length;                   /* of RECORD_NUMBERS */
    bool pointer;                 /* the offset holds a pointer to the value; NULL: there is none */
    record_kind item;             /* of RECORD_LIST and RECORD_MAP; texts are RECORD_CHARS */
    size_t count_at, stride;      /* of an array: offset of its length, an int; size of an item */
    const char *key;              /* of RECORD_MAP: what the names are, for the help */
    const char *unit;             /* NULL: none */
    const char *words;            /* "fine|caution|stop" */
    bool (*when)(const void *of); /* NULL, or the field is there only where this is true */
    bool optional;                /* the field is left out where there is no value */
    bool or_null;                 /* the field is null where there is no value; of a number it always is */
    const record_table *table;
    const char *help; /* what it is, in a few words */
    /* At most one, instead of the offset. `space` is RECORD_SPACE bytes in which the answer may be built. */
    double (*number)(const void *of);                 /* NaN: no value */
    const char *(*text)(const void *of, char *space); /* NULL: no value */
    const void *(*at)(const void *of, void *space);   /* where the value is; NULL: no value */
    /* Of RECORD_LIST and RECORD_MAP, of what is at the offset (which is 0 mostly): the item at *i, which begins at 0
     * and goes up by one each time, or at the next *i that has one; NULL: no more. key is set for a map. */
    const void *(*next)(const void *of, int *i, const char **key, void *space);
} record_row;

struct record_table {
    const char *kind; /* NULL: a part of records */
    const char *title;
    const record_row *row;
    int count;
};
#define RECORD_ROWS(rows) .row = rows, .count = (int)(sizeof rows / sizeof *rows)

#define SEGMENT_WORDS "cranium|maxilla|distal|proximal_left|proximal_right|chin" /* segment_name of each */

/* Kind, place and length of a member, from its type. */
#define RECORD_AT(type, member)                                                                                        \
    .kind = _Generic(&((type *)0)->member,                                                                             \
        double *: RECORD_NUMBER,                                                                                       \
        int *: RECORD_COUNT,                                                                                           \
        int64_t *: RECORD_LONG,                                                                                        \
        bool *: RECORD_BOOL,                                                                                           \
        const char **: RECORD_TEXT,                                                                                    \
        char **: RECORD_TEXT,                                                                                          \
        unsigned *: RECORD_WORD,                                                                                       \
        json_t **: RECORD_JSON,                                                                                        \
        double(*)[2]: RECORD_NUMBERS,                                                                                  \
        double(*)[3]: RECORD_NUMBERS,                                                                                  \
        double(*)[16]: RECORD_NUMBERS,                                                                                 \
        default: RECORD_CHARS),                                                                                        \
    .offset = offsetof(type, member), .length = (int)(sizeof(((type *)0)->member) / sizeof(double))
/* Rows for the usual cases; the others are written out. */
#define ROW(type, member, name_, unit_, help_)                                                                         \
    {                                                                                                                  \
        RECORD_AT(type, member), .name = name_, .unit = unit_, .help = help_                                           \
    }
#define ROW_WHEN(when_, type, member, name_, unit_, help_)                                                             \
    {                                                                                                                  \
        RECORD_AT(type, member), .name = name_, .unit = unit_, .help = help_, .when = when_                            \
    }
#define ROW_OPTIONAL(type, member, name_, unit_, help_)                                                                \
    {                                                                                                                  \
        RECORD_AT(type, member), .name = name_, .unit = unit_, .help = help_, .optional = true                         \
    }
#define ROW_WORD(type, member, name_, words_, help_)                                                                   \
    {                                                                                                                  \
        RECORD_AT(type, member), .name = name_, .words = words_, .help = help_                                         \
    }
#define ROW_FOUND(kind_, function, name_, unit_, help_)                                                                \
    {                                                                                                                  \
        .kind = RECORD_##kind_, .number = function, .name = name_, .unit = unit_, .help = help_                        \
    }
#define ROW_TEXT(function, name_, help_)                                                                               \
    {                                                                                                                  \
        .kind = RECORD_TEXT, .text = function, .name = name_, .help = help_                                            \
    }
/* A struct in the struct, and one to which a pointer in it points. */
#define ROW_OBJECT(type, member, table_, name_, help_)                                                                 \
    {                                                                                                                  \
        .kind = RECORD_OBJECT, .offset = offsetof(type, member), .table = table_, .name = name_, .help = help_         \
    }
#define ROW_BEHIND(type, member, table_, name_, help_)                                                                 \
    {                                                                                                                  \
        .kind = RECORD_OBJECT, .offset = offsetof(type, member), .pointer = true, .table = table_, .name = name_,      \
        .help = help_                                                                                                  \
    }
#define ROW_LIST(next_, table_, name_, help_)                                                                          \
    {                                                                                                                  \
        .kind = RECORD_LIST, .next = next_, .item = RECORD_OBJECT, .table = table_, .name = name_, .help = help_       \
    }
#define ROW_TEXTS(next_, name_, help_)                                                                                 \
    {                                                                                                                  \
        .kind = RECORD_LIST, .next = next_, .item = RECORD_CHARS, .name = name_, .help = help_                         \
    }
#define ROW_MAP(next_, key_, item_, table_, name_, unit_, help_)                                                       \
    {                                                                                                                  \
        .kind = RECORD_MAP, .next = next_, .key = key_, .item = RECORD_##item_, .table = table_, .name = name_,        \
        .unit = unit_, .help = help_                                                                                   \
    }
/* A list of the structs of an array, to which `member` points; its length is in `length_`. */
#define ROW_ARRAY(type, member, length_, table_, name_, help_)                                                         \
    {                                                                                                                  \
        .kind = RECORD_LIST, .offset = offsetof(type, member), .pointer = true, .count_at = offsetof(type, length_),   \
        .stride = sizeof *((type *)0)->member, .item = RECORD_OBJECT, .table = table_, .name = name_, .help = help_    \
    }

/* The record of a struct as a new object. Asserts that a field without a value may have none, and that texts of
 * `words` are among them. */
json_t *record_json(const record_table *t, const void *of);
/* The same as a new object without the three fields at the beginning: for records that hold others. */
json_t *record_part(const record_table *t, const void *of);
/* JSON schema (2020-12) of the records of a table, as a new object. Nothing that is not in the table passes it. */
json_t *record_schema(const record_table *t);
/* The row's nth word (from 0) in place of `word`, which has room for 64 bytes; NULL: it has no more. */
const char *record_word(const record_row *r, int n, char *word);

/* Refuses (ERR_INPUT) what is not a record of this kind and of this format: another kind, a newer format, a file from
 * before records had a kind. */
bool record_check(const json_file *f, const char *kind, err *e) MUST_CHECK;
/* The kind of a record, "" where it has none. */
const char *record_kind_of(const json_t *record);
