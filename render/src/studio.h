/* Private: what a studio and a model are made of. */
#pragma once
#include "render/studio.h"
#include "render/src/canvas.h"
#include "render/src/harmonics.h"

struct studio {
    backend *context;
    gl gl;
    GLuint shade, map, ball, ribbon, finish; /* programs */
    GLuint empty_array;                      /* a vertex array without attributes, for the full-screen triangle */
    canvas sheet;                            /* kept from the last picture: making it costs as much as a small model */
    char description[256];
};

/* Vertices are those of the surface, split where it has a crease. */
struct model {
    studio *home;
    int32_t source_count; /* vertices of the surface */
    int32_t vertex_count, triangle_count;
    bool closed;         /* no border: its inside is never seen */
    int32_t *source;     /* [vertex_count] vertex of the surface */
    int32_t *tri;        /* [3*triangle_count] */
    float *xyz, *normal; /* [3*vertex_count] */
    float *sharp, *soft; /* [HARMONICS*vertex_count] light transfer, and the same spread under the surface */
    int scatter_passes;
    GLuint array, point_buffer, index_buffer;
};

/* values[components*vertex_count] := mean of each with the mean of its neighbours, `passes` times. */
void model_smooth(const model *m, float *values, int components, int passes);
/* Makes the studio's context current; several studios may be open. */
bool studio_use(studio *s, err *e) MUST_CHECK;
/* GL errors since the last call become ERR_RESOURCE. */
bool studio_check(studio *s, const char *doing, err *e);
