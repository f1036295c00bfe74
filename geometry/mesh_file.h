/* mesh_file: reading and writing surfaces and tetrahedra. Format by extension. */
#pragma once
#include "geometry/surface.h"
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct mesh_file_report {
    bool tagged;               /* the file carries SPACE=LPS or SPACE=RAS; a tag wins over the caller's word */
    bool ras;                  /* it said RAS (or, untagged, the caller did) and was turned to LPS */
    int32_t welded_vertices;   /* merged into another at exactly the same place */
    int32_t dropped_triangles; /* that named a vertex twice */
    int32_t split_polygons;    /* of more than three corners, split as fans */
    int32_t joined_vertices;   /* of loose triangles, made one with another near by */
    double joined_mm;          /* within which they were joined; 0: none were */
} mesh_file_report;

typedef enum mesh_space { MESH_SPACE_FROM_FILE, MESH_SPACE_LPS, MESH_SPACE_RAS } mesh_space;

/* .ply, .off, .vtk and .vtp (PolyData; double, vertex numbers kept where no two are at one place), .stl .obj .gltf .glb
 * through assimp (float, all meshes of the file, welded, because these formats repeat a vertex in every triangle or
 * group). Of glTF one node with what is below it: FILE.glb#NODE names it where there are several; refused are required
 * extensions that change shapes and morph targets that are switched on. The result is LPS; numbers are taken as mm
 * without a guess, but glTF is in metres with +y up by definition and is turned: (x, y, z) m -> 1000 (x, -z, y).
 * Colours of vertices are read from .ply only. Untagged files are taken as `space`, FROM_FILE meaning LPS. The caller
 * frees *out. Refuses (ERR_INPUT, with file) unknown extensions and tags, unreadable or truncated files, vertex numbers
 * out of range, coordinates that are not finite, files without triangles; (ERR_GEOMETRY) loose triangles. Those whose
 * corners were rounded one by one are joined within 0.01 mm at most, and vertices are then numbered anew. report may be
 * NULL. */
bool mesh_read_surface(const char *path, mesh_space space, surface *out, mesh_file_report *report, err *e) MUST_CHECK;

/* Merges vertices at exactly the same place into the first of them, then drops triangles that name a vertex
 * twice. Unused vertices stay. Adds to the report's counts. */
void mesh_weld(surface *s, mesh_file_report *report);

/* .ply (binary little-endian, double), .stl (binary, float), .obj; tagged SPACE=LPS. Colours are
 * written to .ply only. The file appears whole or not at all. Refuses (ERR_USAGE) other extensions. */
bool mesh_write_surface(const surface *s, const char *path, err *e) MUST_CHECK;
/* The same for viewers: floats in a .ply too, because three.js cannot draw doubles. */
bool mesh_write_surface_float(const surface *s, const char *path, err *e) MUST_CHECK;

typedef struct point_array { /* a named array of doubles per node, for VTK files */
    const char *name;
    int components;
    const double *value; /* [components*vertex_count] */
} point_array;

/* .vtu, appended raw, SPACE=LPS as a comment (meshio reads no file with text in its field data); cell array "region".
 * An array named "displacement" becomes the vectors that viewers warp by. Refuses (ERR_USAGE) other extensions. */
bool mesh_write_tets(const tetmesh *m, const point_array *arrays, int array_count, const char *path, err *e) MUST_CHECK;

/* .vtp, appended raw, SPACE=LPS in the field data; the first array is the active scalar. Refuses (ERR_USAGE) other
 * extensions. */
bool mesh_write_surface_arrays(const surface *s, const point_array *arrays, int array_count, const char *path,
                               err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
