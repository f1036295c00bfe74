#include "geometry/mesh_file.h"
#include "geometry/src/file_name.h"
#include "geometry/write_whole.h"
#include <assert.h>
#include <inttypes.h>
#include <string.h>

/* An 8-byte length, then the data. */
static uint64_t announce(FILE *to, const char *type, const char *name, int components, uint64_t bytes, uint64_t offset)
{
    fprintf(to,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%" PRIu64
            "\"/>\n",
            type, name, components, offset);
    return offset + 8 + bytes;
}

static void put_block(FILE *to, const void *data, uint64_t bytes)
{
    (void)!fwrite(&bytes, sizeof bytes, 1, to);
    (void)!fwrite(data, 1, (size_t)bytes, to);
}

static bool plain_name(const char *name)
{
    return *name && !name[strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-")];
}

bool mesh_write_surface_arrays(const surface *s, const point_array *arrays, int array_count, const char *path, err *e)
{
    if (!file_name_ends(path, ".vtp"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "unknown kind of file for a surface with numbers; written is .vtp");
    uint64_t n = (uint64_t)s->vertex_count, cells = (uint64_t)s->triangle_count, at = 0;
    for (int i = 0; i < array_count; i++) assert(plain_name(arrays[i].name) && arrays[i].components > 0);
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    FILE *to = w.stream;
    fprintf(to,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n"
            "<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">76 80 83 0</Array>\n"
            "</FieldData>\n<Piece NumberOfPoints=\"%" PRIu64 "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"%" PRIu64 "\">\n<PointData%s%s%s>\n",
            n, cells, array_count ? " Scalars=\"" : "", array_count ? arrays[0].name : "", array_count ? "\"" : "");
    for (int i = 0; i < array_count; i++)
        at = announce(to, "Float64", arrays[i].name, arrays[i].components, 8 * n * (uint64_t)arrays[i].components, at);
    fprintf(to, "</PointData>\n<Points>\n");
    at = announce(to, "Float64", "Points", 3, 24 * n, at);
    fprintf(to, "</Points>\n<Polys>\n");
    at = announce(to, "Int32", "connectivity", 1, 12 * cells, at);
    announce(to, "Int64", "offsets", 1, 8 * cells, at);
    fprintf(to, "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    for (int i = 0; i < array_count; i++)
        put_block(to, arrays[i].value, 8 * n * (uint64_t)arrays[i].components);
    put_block(to, s->xyz, 24 * n);
    put_block(to, s->tri, 12 * cells);
    uint64_t bytes = 8 * cells;
    (void)!fwrite(&bytes, sizeof bytes, 1, to);
    for (uint64_t t = 1; t <= cells; t++) (void)!fwrite(&(int64_t){3 * (int64_t)t}, 8, 1, to);
    fprintf(to, "\n</AppendedData>\n</VTKFile>\n");
    return whole_file_close(&w, e);
}
