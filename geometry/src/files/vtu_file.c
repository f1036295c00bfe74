#include "geometry/mesh_file.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/vtk_xml.h"
#include "geometry/write_whole.h"
#include <inttypes.h>
#include <string.h>

enum { VTK_TETRA = 10 };

static void write_header(const tetmesh *m, const point_array *arrays, int array_count, FILE *to)
{
    uint64_t n = (uint64_t)m->vertex_count, cells = (uint64_t)m->tet_count, offset = 0;
    const char *vectors = "";
    for (int i = 0; i < array_count; i++)
        if (!strcmp(arrays[i].name, "displacement")) vectors = " Vectors=\"displacement\"";
    fprintf(
        to,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<!-- SPACE=LPS, mm -->\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"%" PRIu64
        "\" NumberOfCells=\"%" PRIu64 "\">\n<PointData%s>\n",
        n, cells, vectors);
    offset = vtk_announce_arrays(to, arrays, array_count, n, offset);
    fprintf(to, "</PointData>\n<CellData Scalars=\"region\">\n");
    offset = vtk_announce(to, "Int32", "region", 1, 4 * cells, offset);
    fprintf(to, "</CellData>\n<Points>\n");
    offset = vtk_announce(to, "Float64", "Points", 3, 24 * n, offset);
    fprintf(to, "</Points>\n<Cells>\n");
    offset = vtk_announce(to, "Int64", "connectivity", 1, 32 * cells, offset);
    offset = vtk_announce(to, "Int64", "offsets", 1, 8 * cells, offset);
    vtk_announce(to, "UInt8", "types", 1, cells, offset);
    fprintf(to, "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
}

static void write_data(const tetmesh *m, const point_array *arrays, int array_count, FILE *to)
{
    uint64_t n = (uint64_t)m->vertex_count, cells = (uint64_t)m->tet_count;
    vtk_put_arrays(to, arrays, array_count, n);
    vtk_put_block(to, m->region, 4 * cells);
    vtk_put_block(to, m->xyz, 24 * n);
    uint64_t bytes = 32 * cells;
    (void)!fwrite(&bytes, sizeof bytes, 1, to);
    for (uint64_t i = 0; i < 4 * cells; i++) (void)!fwrite(&(int64_t){m->tet[i]}, 8, 1, to);
    bytes = 8 * cells;
    (void)!fwrite(&bytes, sizeof bytes, 1, to);
    for (uint64_t t = 0; t < cells; t++) (void)!fwrite(&(int64_t){4 * ((int64_t)t + 1)}, 8, 1, to);
    (void)!fwrite(&cells, sizeof cells, 1, to);
    for (uint64_t t = 0; t < cells; t++) fputc(VTK_TETRA, to);
    fprintf(to, "\n</AppendedData>\n</VTKFile>\n");
}

bool mesh_write_tets(const tetmesh *m, const point_array *arrays, int array_count, const char *path, err *e)
{
    if (!file_name_ends(path, ".vtu"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "unknown kind of file for tetrahedra; written is .vtu");
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    write_header(m, arrays, array_count, w.stream);
    write_data(m, arrays, array_count, w.stream);
    return whole_file_close(&w, e);
}
