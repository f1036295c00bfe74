/* mesh_file: reading and writing surfaces and tetrahedra. Format by extension. */
#pragma once
#include "geometry/surface.h"
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct mesh_file_report {
    bool tagged;                /* the file carries a SPACE=LPS or SPACE=RAS tag */
    bool ras;                   /* it said RAS (or the caller did) and was turned to LPS */
    int32_t welded_vertices, dropped_triangles, split_polygons;
} mesh_file_report;

typedef enum mesh_space { MESH_SPACE_FROM_FILE, MESH_SPACE_LPS, MESH_SPACE_RAS } mesh_space;

/* .ply and .off through CGAL, .stl .obj .gltf .glb through assimp (STL and OBJ welded). The result is LPS, mm as
 * stored (no unit guess). Untagged files are taken as `space`, FROM_FILE meaning LPS. The caller frees *out.
 * Refuses (ERR_INPUT) unknown extensions, unreadable files, files without triangles. report may be NULL. */
bool mesh_read_surface(const char *path, mesh_space space, surface *out, mesh_file_report *report, err *e) MUST_CHECK;

/* .ply (binary little-endian, double), .stl (binary), .obj; tagged SPACE=LPS. rgb[3*vertex_count] (0..255) may be
 * NULL and is written to .ply only. The file appears whole or not at all. */
bool mesh_write_surface(const surface *s, const uint8_t *rgb, const char *path, err *e) MUST_CHECK;

typedef struct point_array { /* a named array of doubles per node, for VTU files */
    const char *name;
    int components;
    const double *value; /* [components*vertex_count] */
} point_array;

/* .vtu, appended raw, SPACE=LPS in the field data; cell array "region". */
bool mesh_write_tets(const tetmesh *m, const point_array *arrays, int array_count, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
