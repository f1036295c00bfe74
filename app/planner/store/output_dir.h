/* output_dir: a folder of results that appears whole or not at all. Files are made in `part.temporary`. */
#pragma once
#include "geometry/write_whole.h"

typedef struct output_dir {
    whole_folder part;
} output_dir;

/* Refuses (ERR_INPUT) a target that is in use: something that gnathos did not write (a folder without
 * one of its records) always, an earlier output unless `force`. Refuses (ERR_RESOURCE) a folder
 * that cannot be written or that another process is making. */
bool output_dir_open(const char *target, bool force, output_dir *out, err *e) MUST_CHECK;
/* After refusal the earlier output, if any, is as it was. */
bool output_dir_close(output_dir *d, err *e) MUST_CHECK;
void output_dir_abandon(output_dir *d); /* idempotent; removes what was made */
/* part.temporary/name in a new string; the caller frees it. */
char *output_dir_file(const output_dir *d, const char *name);
