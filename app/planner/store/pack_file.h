/* pack_file: named arrays in one file, for what is prepared once and reused on the same machine (native byte
 * order). A checksum at the end tells a torn or edited file from a whole one. */
#pragma once
#include "geometry/write_whole.h"
#include <stddef.h>
#include <stdint.h>

enum { PACK_NAME_SIZE = 32 };

typedef struct pack_entry {
    char name[PACK_NAME_SIZE];
    uint64_t size; /* bytes */
    void *bytes;
} pack_entry;

typedef struct pack_file {
    int count;
    pack_entry *entry;
} pack_file;

/* Copies the bytes in. */
void pack_put(pack_file *p, const char *name, const void *bytes, size_t size);
/* A copy of the array of that name, count = size / element; the caller frees. NULL where the name is missing
 * or its size is not a multiple of `element`. */
void *pack_take(const pack_file *p, const char *name, size_t element, size_t *count);
void pack_free(pack_file *p);

bool pack_write(const pack_file *p, const char *path, err *e) MUST_CHECK;
/* Into a file that is open already, which it closes. */
bool pack_write_into(const pack_file *p, whole_file *f, err *e) MUST_CHECK;
/* Refuses (ERR_INPUT) what is not a whole pack file. */
bool pack_read(const char *path, pack_file *out, err *e) MUST_CHECK;
