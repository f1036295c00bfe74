/* readers: every reader of files, to be fed any bytes at all. A reader must refuse them with one line of text or hand
 * out what its header promises; anything else ends the program. */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct reader {
    const char *name; /* its corpus is the folder corpus/NAME */
    const char *file; /* the name its bytes take in the folder of work */
    bool (*read)(const char *path);
    const char *before; /* stands in the file before the bytes; NULL: nothing */
} reader;

extern const reader readers[];
extern const int reader_count;

/* NULL if there is none. */
const reader *reader_find(const char *name);
/* Makes a folder of work under TMPDIR (or /tmp) with what readers look for beside their file; it goes at exit. */
void reader_prepare(void);
/* Writes the bytes to the reader's file and reads it. True: accepted. */
bool reader_feed(const reader *r, const uint8_t *bytes, size_t size);
