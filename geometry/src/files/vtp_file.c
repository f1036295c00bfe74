#include "geometry/mesh_file.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/vtk_xml.h"
#include "geometry/write_whole.h"
#include <inttypes.h>

bool mesh_write_surface_arrays(const surface *s, const point_array *arrays, int array_count, const char *path, err *e)
{
    if (!file_name_ends(path, ".vtp"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "unknown kind of file for a surface with numbers; written is .vtp");
    uint64_t n = (uint64_t)s->vertex_count, cells = (uint64_t)s->triangle_count, at = 0;
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
    at = vtk_announce_arrays(to, arrays, array_count, n, at);
    fprintf(to, "</PointData>\n<Points>\n");
    at = vtk_announce(to, "Float64", "Points", 3, 24 * n, at);
    fprintf(to, "</Points>\n<Polys>\n");
    at = vtk_announce(to, "Int32", "connectivity", 1, 12 * cells, at);
    vtk_announce(to, "Int64", "offsets", 1, 8 * cells, at);
    fprintf(to, "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    vtk_put_arrays(to, arrays, array_count, n);
    vtk_put_block(to, s->xyz, 24 * n);
    vtk_put_block(to, s->tri, 12 * cells);
    uint64_t bytes = 8 * cells;
    (void)!fwrite(&bytes, sizeof bytes, 1, to);
    for (uint64_t t = 1; t <= cells; t++) (void)!fwrite(&(int64_t){3 * (int64_t)t}, 8, 1, to);
    fprintf(to, "\n</AppendedData>\n</VTKFile>\n");
    return whole_file_close(&w, e);
}
