#include "app/report/packed.h"
#include "geometry/mem.h"
#include <assert.h>
#include <nettle/base64.h>
#include <stdlib.h>
#include <zlib.h>

void packed_add(packed *p, const int32_t *value, size_t count, size_t stride)
{
    p->bytes = GROW_ARRAY(uint8_t, p->bytes, p->size + 4 * count);
    for (size_t i = 0; i < count; i++) {
        uint32_t step = (uint32_t)value[i] - (i < stride ? 0 : (uint32_t)value[i - stride]);
        uint32_t folded = step << 1 ^ (step >> 31 ? UINT32_MAX : 0);
        for (size_t k = 0; k < 4; k++) p->bytes[p->size + k * count + i] = (uint8_t)(folded >> 8 * k);
    }
    p->size += 4 * count;
}

char *packed_text(const packed *p)
{
    uLongf size = compressBound(p->size);
    Bytef *small = NEW_ARRAY(Bytef, size);
    int status = compress2(small, &size, p->bytes, p->size, Z_BEST_COMPRESSION);
    assert(status == Z_OK);
    char *text = base64_text(small, size);
    free(small);
    return text;
}

void packed_free(packed *p)
{
    free(p->bytes);
    *p = (packed){0};
}

char *base64_text(const void *bytes, size_t size)
{
    size_t length = BASE64_ENCODE_RAW_LENGTH(size);
    char *text = NEW_ARRAY(char, length + 1);
    base64_encode_raw(text, size, bytes);
    return text;
}
