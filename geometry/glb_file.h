/* glb_file: shapes as binary glTF 2.0, each with its planned place as the morph target "planned".
 *
 * Vertices stay LPS mm; the root node takes them to the axes of glTF (metres, +y up, +z the way the face looks):
 * (x, y, z) mm -> 0.001 (x, z, -y) m, as mesh_file.h reads them back. asset.extras says so. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct glb_shape {
    const char *name;
    const surface *rest;   /* its vertices' colours, if it has any, go before rgb */
    const double *planned; /* [3*vertex_count] mm, or NULL: no morph target */
    double rgb[3];         /* sRGB, 0..1 */
} glb_shape;

/* Weights are 0, so that a viewer opens with the shapes at rest. Coordinates are floats (3e-5 mm at 300 mm). The file
 * appears whole or not at all. Refuses (ERR_USAGE) an extension other than .glb, (ERR_RESOURCE) more than 4 GiB. */
bool glb_write(const glb_shape *shapes, int count, const char *path, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
