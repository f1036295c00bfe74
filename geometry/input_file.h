/* input_file: a file that may be read: regular, not empty, not larger than its reader can hold. Pipes and devices are
 * refused before they are opened for good, so that no reader waits for ever or reads without an end. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#include <stdio.h>
#ifdef __cplusplus
extern "C" {
#endif

enum { INPUT_TEXT_BYTES = 64 << 20 }; /* the most that readers of text take */

/* Opens a regular file of 1 to most_bytes bytes; size (may be NULL) is set to how many. The caller closes it. NULL:
 * refused (ERR_INPUT, with path). */
FILE *input_file_open(const char *path, int64_t most_bytes, int64_t *size, err *e);
/* The same for text, at most INPUT_TEXT_BYTES; a byte order mark of UTF-8, as some editors write it, is skipped.
 * Refuses UTF-16 too. */
FILE *input_file_open_text(const char *path, err *e);
/* All bytes of such a file, followed by a byte 0; the caller frees *bytes. */
bool input_file_load(const char *path, int64_t most_bytes, char **bytes, size_t *size, err *e) MUST_CHECK;
/* Whether a text begins with a byte order mark: refuses UTF-16 (ERR_INPUT, with path); *utf8 is set where three bytes
 * are to be skipped. */
bool input_text_mark(const char *text, size_t size, const char *path, bool *utf8, err *e) MUST_CHECK;
/* The same for readers that cannot skip it: refuses any mark. */
bool input_text_unmarked(const char *text, size_t size, const char *path, err *e) MUST_CHECK;
/* Refuses what input_file_open and input_text_unmarked refuse; for readers that open the file themselves. */
bool input_file_check(const char *path, int64_t most_bytes, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
