/* inflate: what zlib has compressed. Private. */
#pragma once
#include <stdbool.h>
#include <stddef.h>

/* Deflate cannot make more of n bytes: what promises more is false, and needs no memory to be found so. */
static inline bool inflate_can_give(size_t n, size_t bytes) { return bytes / 1032 <= n; }
/* One stream (zlib's or gzip's) of n bytes into exactly `bytes` bytes; false if it is broken or holds another number.
 */
bool inflate_bytes(const void *in, size_t n, void *out, size_t bytes);
