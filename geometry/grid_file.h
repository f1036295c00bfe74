/* grid_file: numbers on the nodes of a regular grid, for ParaView and VTK. */
#pragma once
#include "geometry/mesh_file.h"
#ifdef __cplusplus
extern "C" {
#endif

/* .vti, appended raw, arrays [components*count[0]*count[1]*count[2]] with the first axis fastest; the first array is
 * the active scalar. Refuses (ERR_USAGE) other extensions, (ERR_RESOURCE) what the disk refuses. */
bool grid_file_write(const int32_t count[3], const double origin[3], const double spacing[3], const point_array *arrays,
                     int array_count, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
