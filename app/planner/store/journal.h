/* journal: an append-only file of finished pieces of work, so that a run that was killed goes on where it was.
 *
 * Each record has its kind, size and checksum and is written in one call; what a kill cut off at the end is dropped
 * when the journal is opened again. The file begins with a key, the hash of all that the work depends on. */
#pragma once
#include "app/planner/store/content_hash.h"
#include <stdint.h>

typedef struct journal {
    int file; /* open and locked */
    char *path;
    int64_t record_count; /* read and written */
} journal;

/* Told each whole record in the order of the file; false: refuses it, with *e filled. */
typedef bool journal_reader(uint32_t kind, const void *bytes, size_t size, void *context, err *e);

/* Makes the file, or reads the records of one that is there. Refuses (ERR_INPUT) a file that is no journal or has
 * another key unless `force`, which starts anew; (ERR_RESOURCE) one that another process works on, or that cannot be
 * written. After true, end with journal_close or journal_remove. */
bool journal_open(const char *path, const char *key, bool force, journal_reader *reader, void *context, journal *out,
                  err *e) MUST_CHECK;
/* Not from two threads at once. Refuses (ERR_RESOURCE) what the disk refuses. */
bool journal_add(journal *j, uint32_t kind, const void *bytes, size_t size, err *e) MUST_CHECK;
void journal_close(journal *j);  /* idempotent; the file stays */
void journal_remove(journal *j); /* closes and deletes the file: the work is done */
