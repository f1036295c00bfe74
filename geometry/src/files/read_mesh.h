/* read_mesh: polygons as a file holds them, before anything is checked, split or turned. Private. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
typedef struct polygons {
    int64_t point_count, polygon_count;
    double *xyz;          /* [3*point_count] as stored */
    int64_t *first;       /* [polygon_count+1] where each polygon's corners start */
    int64_t *corner;      /* [first[polygon_count]] point numbers, not checked */
    uint8_t *rgb;         /* [3*point_count] colours of the points, or NULL */
    int64_t open_corners; /* of a polygon not closed yet */
    char space[8];        /* what the data say of their axes: "LPS", "RAS"; "": nothing, or it is in the header */
} polygons;

polygons polygons_new(void);
void polygons_free(polygons *p);
/* Each makes its own room, so that a reader never believes a number of things before they are there. */
void polygons_add_point(polygons *p, const double xyz[3]);
void polygons_add_corner(polygons *p, int64_t point);
void polygons_close(polygons *p);       /* the corners added since the last are a polygon */
void polygons_close_strip(polygons *p); /* or a strip of triangles, which become polygons */

/* Each refuses (ERR_INPUT, with the line of a text) what is not complete; double coordinates are kept bit for bit. */
bool read_mesh_ply(const char *path, polygons *out, err *e) MUST_CHECK; /* colours too, where they are bytes */
bool read_mesh_off(const char *path, polygons *out, err *e) MUST_CHECK; /* text */
bool read_mesh_vtk(const char *path, polygons *out, err *e) MUST_CHECK; /* legacy, PolyData */
bool read_mesh_vtp(const char *path, polygons *out, err *e) MUST_CHECK; /* XML, PolyData; zlib or plain */
/* .stl .obj .gltf .glb, with assimp: the meshes of the scene, in place, float precision; keep as
 * gltf_check makes it, NULL for all. */
bool read_mesh_scene(const char *path, const uint8_t *keep, int keep_count, polygons *out, err *e) MUST_CHECK;
