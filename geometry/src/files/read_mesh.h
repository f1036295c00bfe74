/* read_mesh: polygons as a file holds them, before anything is checked, split or turned. Private. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct polygons {
    int64_t point_count, polygon_count;
    double *xyz;     /* [3*point_count] as stored */
    int64_t *first;  /* [polygon_count+1] where each polygon's corners start */
    int64_t *corner; /* [first[polygon_count]] point numbers, not checked */
    uint8_t *rgb;    /* [3*point_count] colours of the points, or NULL */
} polygons;

void polygons_free(polygons *p);

/* .ply and .off, with CGAL (geometry/cgal/read_mesh.cpp): double coordinates are kept bit for bit. assimp is
 * not used for PLY because 5.2.5 reads a binary file whose data start with 0x0A as nonsense, and reports
 * success. */
bool read_mesh_polygons(const char *path, polygons *out, err *e) MUST_CHECK;
/* .stl .obj .gltf .glb, with assimp: the meshes of the scene, in place, float precision; keep as
 * gltf_check makes it, NULL for all. */
bool read_mesh_scene(const char *path, const uint8_t *keep, int keep_count, polygons *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
