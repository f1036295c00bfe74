#include "geometry/src/files/inflate.h"
#include <stdint.h>
#include <zlib.h>

static const size_t most = 1 << 30; /* zlib counts with 32 bits */

bool inflate_bytes(const void *in, size_t n, void *out, size_t bytes)
{
    z_stream z = {.next_in = (z_const Bytef *)(uintptr_t)in, .next_out = out};
    if (inflateInit2(&z, 15 + 32) != Z_OK) return false;
    int status = Z_OK;
    while (status == Z_OK) {
        uInt give = (uInt)(n < most ? n : most), room = (uInt)(bytes < most ? bytes : most);
        z.avail_in = give;
        z.avail_out = room;
        status = inflate(&z, Z_NO_FLUSH);
        n -= give - z.avail_in;
        bytes -= room - z.avail_out;
        if (status == Z_OK && give == z.avail_in && room == z.avail_out) break; /* nothing moves any more */
    }
    inflateEnd(&z);
    return status == Z_STREAM_END && !bytes;
}
