/* Private: what a studio and a model are made of. */
#pragma once
#include "render/studio.h"
#include "render/src/canvas.h"

enum { HARMONICS = 9 };

struct studio {
    backend *context;
    gl gl;
    GLuint shade, ball, ribbon, finish; /* programs */
    GLuint empty_array;                 /* a vertex array without attributes, for the full-screen triangle */
    canvas sheet; /* kept from the last picture: making it costs as much as a small model */
    char description[256];
};

/* Vertices are those of the surface, split where it has a crease. */
struct model {
    studio *home;
    int32_t source_count; /* vertices of the surface */
    int32_t vertex_count, triangle_count;
    int32_t *source;     /* [vertex_count] vertex of the surface */
    int32_t *tri;        /* [3*triangle_count] */
    float *xyz, *normal; /* [3*vertex_count] */
    int scatter_passes;
    GLuint array, point_buffer, normal_buffer, transfer_buffer, index_buffer;
};

/* Spherical harmonics of the unit vector d up to degree 2, real, orthonormal. */
void harmonics_at(const double d[3], double y[HARMONICS]);
/* Direction i of n, spread evenly over the sphere (Fibonacci spiral). */
void sphere_direction(int i, int n, double d[3]);
/* values[components*vertex_count] := mean of each with the mean of its neighbours, `passes` times. */
void model_smooth(const model *m, float *values, int components, int passes);
/* transfer[2*HARMONICS*vertex_count]: sharp, then scattered. Uploads it. */
void model_set_transfer(model *m, const float *transfer);
/* Makes the studio's context current; several studios may be open. */
bool studio_use(studio *s, err *e) MUST_CHECK;
/* GL errors since the last call become ERR_RESOURCE. */
bool studio_check(studio *s, const char *doing, err *e);
