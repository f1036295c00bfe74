/* json_file: a JSON document that knows the line of each value. The one file that includes jansson: readers
 * of JSON include this header and walk `root` with jansson's own json_object_get() and the like.
 *
 * A place in a document is a JSON pointer: "" is the whole, "/segments/maxilla/translate_mm/2" the third
 * number. */
#pragma once
#include "geometry/err.h"
#include <jansson.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct json_file {
    char *path;   /* as given; the start of every message */
    char *text;   /* the file */
    json_t *root; /* owned; values got from it are borrowed */
} json_file;

/* Reads and parses. Refuses (ERR_INPUT, "path:line: ...") what is not a readable regular file of at most 64
 * MiB, broken syntax, duplicate keys, NaN and numbers beyond double; every number in root is finite. The
 * caller frees *out. */
bool json_file_read(const char *path, json_file *out, err *e) MUST_CHECK;
/* The same from memory; path is only named in messages. */
bool json_file_parse(const char *text, size_t size, const char *path, json_file *out, err *e) MUST_CHECK;
void json_file_free(json_file *f); /* idempotent, leaves zero */

/* Line, from 1, of the value at the pointer (of its key, for a member); the line of the nearest value around
 * it where the document has no such value. */
int json_file_line(const json_file *f, const char *pointer);
/* The pointer as people write it: "/segments/maxilla/translate_mm/2" -> "segments.maxilla.translate_mm[2]".
 */
void json_file_field(const json_file *f, const char *pointer, char *field, size_t size);

/* ERR_INPUT "path:line: field: text" for the value at the pointer ("": no field). Always false. */
bool json_file_refuse(const json_file *f, const char *pointer, err *e, const char *fmt, ...) PRINTF_LIKE(4, 5);

/* Three finite numbers of an array value, else refused as above. */
bool json_file_vec3(const json_file *f, const json_t *value, const char *pointer, double out[3], err *e) MUST_CHECK;

/* Writes root, indented, reals with 17 digits, keys in the order of insertion. The file appears whole or not
 * at all. Refuses (ERR_RESOURCE) what the disk refuses. */
bool json_file_write(const json_t *root, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
