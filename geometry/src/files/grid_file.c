#include "geometry/grid_file.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/vtk_xml.h"
#include "geometry/write_whole.h"

bool grid_file_write(const int32_t count[3], const double origin[3], const double spacing[3], const point_array *arrays,
                     int array_count, const char *path, err *e)
{
    if (!file_name_ends(path, ".vti"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "unknown kind of file for a grid; written is .vti");
    uint64_t n = (uint64_t)count[0] * (uint64_t)count[1] * (uint64_t)count[2];
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    fprintf(w.stream,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<ImageData WholeExtent=\"0 %d 0 %d 0 %d\" Origin=\"%.17g %.17g %.17g\" "
            "Spacing=\"%.17g %.17g %.17g\">\n<Piece Extent=\"0 %d 0 %d 0 %d\">\n<PointData%s%s%s>\n",
            count[0] - 1, count[1] - 1, count[2] - 1, origin[0], origin[1], origin[2], spacing[0], spacing[1],
            spacing[2], count[0] - 1, count[1] - 1, count[2] - 1, array_count ? " Scalars=\"" : "",
            array_count ? arrays[0].name : "", array_count ? "\"" : "");
    vtk_announce_arrays(w.stream, arrays, array_count, n, 0);
    fprintf(w.stream, "</PointData>\n<CellData/>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_");
    vtk_put_arrays(w.stream, arrays, array_count, n);
    fprintf(w.stream, "\n</AppendedData>\n</VTKFile>\n");
    return whole_file_close(&w, e);
}
