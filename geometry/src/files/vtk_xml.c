#include "geometry/src/files/vtk_xml.h"
#include <assert.h>
#include <inttypes.h>
#include <string.h>

uint64_t vtk_announce(FILE *to, const char *type, const char *name, int components, uint64_t bytes, uint64_t offset)
{
    fprintf(to,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%" PRIu64
            "\"/>\n",
            type, name, components, offset);
    return offset + 8 + bytes;
}

void vtk_put_block(FILE *to, const void *data, uint64_t bytes)
{
    (void)!fwrite(&bytes, sizeof bytes, 1, to);
    (void)!fwrite(data, 1, (size_t)bytes, to);
}

static bool plain_name(const char *name)
{
    return *name && !name[strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-")];
}

uint64_t vtk_announce_arrays(FILE *to, const point_array *arrays, int count, uint64_t points, uint64_t offset)
{
    for (int i = 0; i < count; i++) {
        assert(plain_name(arrays[i].name) && arrays[i].components > 0);
        offset = vtk_announce(to, "Float64", arrays[i].name, arrays[i].components,
                              8 * points * (uint64_t)arrays[i].components, offset);
    }
    return offset;
}

void vtk_put_arrays(FILE *to, const point_array *arrays, int count, uint64_t points)
{
    for (int i = 0; i < count; i++) vtk_put_block(to, arrays[i].value, 8 * points * (uint64_t)arrays[i].components);
}
