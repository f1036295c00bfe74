/* write_whole: outputs that appear whole or not at all. The bytes go to a temporary name beside the target,
 * are flushed to the disk and take the target's name in one step. What killed processes left under temporary names of
 * the same target is removed when it is opened. */
#pragma once
#include "geometry/err.h"
#include <stddef.h>
#include <stdio.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct whole_file {
    FILE *stream; /* write here; write errors are found by whole_file_close */
    char *path, *temporary;
} whole_file;

/* Refuses (ERR_RESOURCE) a folder that is missing or not writable. After true, end with close or abandon. */
bool whole_file_open(const char *path, whole_file *out, err *e) MUST_CHECK;
/* An existing file of that name is replaced. On refusal the temporary file is gone and the old file is as it
 * was. */
bool whole_file_close(whole_file *w, err *e) MUST_CHECK;
void whole_file_abandon(whole_file *w); /* idempotent */

bool write_whole(const char *path, const void *bytes, size_t size, err *e) MUST_CHECK;

typedef struct whole_folder {
    char *path, *temporary; /* make the files in `temporary` */
    int lock;               /* held on it while this process works */
    bool replaces;
} whole_folder;

/* Refuses (ERR_INPUT) a target that exists and is not an empty folder, (ERR_RESOURCE) one that another process is
 * making. What killed processes left of the same target is removed. */
bool whole_folder_open(const char *path, whole_folder *out, err *e) MUST_CHECK;
/* The same for a folder that stands and is replaced by whole_folder_close in one step (in two where the file system
 * cannot exchange names); on refusal it is as it was. */
bool whole_folder_open_over(const char *path, whole_folder *out, err *e) MUST_CHECK;
bool whole_folder_close(whole_folder *w, err *e) MUST_CHECK;
void whole_folder_abandon(whole_folder *w); /* removes the temporary folder and all in it; idempotent */

/* Removes the temporary files and folders of this process. For a process about to end: allocates nothing, may be called
 * from a signal handler. */
void whole_folder_abandon_all(void);

#ifdef __cplusplus
}
#endif
