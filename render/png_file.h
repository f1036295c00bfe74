/* png_file: images in files. */
#pragma once
#include "render/image.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct png_note { /* a tEXt chunk, or iTXt where the value is not ASCII; UTF-8, keyword of 1 to 79 characters */
    const char *key, *value;
} png_note;

/* 8-bit RGBA, or RGB where the image is opaque throughout, with the texts and no time stamp: same image and
 * texts, same bytes. The file appears whole or not at all. Refuses (ERR_RESOURCE) what cannot be written,
 * (ERR_USAGE) a bad keyword. */
bool png_file_write(const image *im, const png_note *texts, int text_count, const char *path, err *e) MUST_CHECK;
/* *out is created; the caller frees it. Refuses (ERR_INPUT) what is not a whole PNG file. */
bool png_file_read(const char *path, image *out, err *e) MUST_CHECK;
/* The value of such a chunk, newly allocated; NULL in *value if there is none. */
bool png_file_note(const char *path, const char *key, char **value, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
