/* content_hash: SHA-256 of what a result was made from. */
#pragma once
#include "geometry/err.h"
#include <stddef.h>

enum { HASH_TEXT_SIZE = 65 };

typedef struct content_hash content_hash;

content_hash *content_hash_start(void);
void content_hash_bytes(content_hash *h, const void *bytes, size_t size);
/* "name=value\n" with all digits of the number. */
void content_hash_number(content_hash *h, const char *name, double value);
void content_hash_text(content_hash *h, const char *name, const char *value);
/* The bytes of a file; an empty path counts as an empty file. Refuses (ERR_INPUT) one that cannot be read. */
bool content_hash_file(content_hash *h, const char *name, const char *path, err *e) MUST_CHECK;
/* Lower-case hexadecimal; frees the hash. */
void content_hash_end(content_hash *h, char text[HASH_TEXT_SIZE]);
