#include "app/planner/store/content_hash.h"
#include "geometry/mem.h"
#include "geometry/input_file.h"
#include <nettle/sha2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(HASH_TEXT_SIZE == 2 * SHA256_DIGEST_SIZE + 1, "two digits a byte");

struct content_hash {
    struct sha256_ctx state;
};

content_hash *content_hash_start(void)
{
    content_hash *h = NEW_ARRAY(content_hash, 1);
    sha256_init(&h->state);
    return h;
}

void content_hash_bytes(content_hash *h, const void *bytes, size_t size) { sha256_update(&h->state, size, bytes); }

void content_hash_number(content_hash *h, const char *name, double value)
{
    char line[256];
    snprintf(line, sizeof line, "%s=%.17g\n", name, value);
    content_hash_bytes(h, line, strlen(line));
}

void content_hash_text(content_hash *h, const char *name, const char *value)
{
    content_hash_bytes(h, name, strlen(name) + 1);
    content_hash_bytes(h, value, strlen(value) + 1);
}

bool content_hash_file(content_hash *h, const char *name, const char *path, err *e)
{
    content_hash_text(h, "file", name);
    if (!path[0]) return true;
    FILE *f = input_file_open(path, INT64_MAX, NULL, e);
    if (!f) return false;
    char block[65536];
    for (size_t n; (n = fread(block, 1, sizeof block, f)) > 0;) content_hash_bytes(h, block, n);
    bool failed = ferror(f);
    fclose(f);
    return failed ? err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read to its end") : true;
}

void content_hash_end(content_hash *h, char text[HASH_TEXT_SIZE])
{
    uint8_t digest[SHA256_DIGEST_SIZE];
    sha256_digest(&h->state, sizeof digest, digest);
    for (size_t i = 0; i < sizeof digest; i++) snprintf(text + 2 * i, 3, "%02x", digest[i]);
    free(h);
}
