/* packed: numbers and bytes as text that a page can hold. */
#pragma once
#include <stddef.h>
#include <stdint.h>

typedef struct packed {
    uint8_t *bytes;
    size_t size;
} packed;

/* Appends count whole numbers so that they compress well: the difference to the number `stride` before (0 before the
 * first ones), its sign moved into the lowest bit, then the lowest byte of all of them, the next byte of all, ... */
void packed_add(packed *p, const int32_t *value, size_t count, size_t stride);
/* All that was appended, in zlib's format (RFC 1950), as base64. The caller frees it. */
char *packed_text(const packed *p);
void packed_free(packed *p); /* idempotent, leaves zero */

/* Base64 (RFC 4648). The caller frees it. */
char *base64_text(const void *bytes, size_t size);
