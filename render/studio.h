/* studio: the off-screen drawing context, and models: surfaces made ready for it.
 *
 * A studio belongs to the thread that opened it. Nothing here needs a display. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct studio studio;

/* Refuses (ERR_RESOURCE), naming what is missing, when no OpenGL 3.3 core context can be made. */
bool studio_open(studio **out, err *e) MUST_CHECK;
void studio_close(studio **s); /* idempotent; models made in it must be freed before */
/* "OSMesa, llvmpipe (LLVM 15.0.6, 256 bits), 3.3 (Core Profile) Mesa 22.3.6" */
const char *studio_description(const studio *s);

/* How a surface is made ready. Shading only: the geometry that is drawn is the surface as given. */
typedef struct model_params {
    /* Triangles that meet at more than this angle get normals of their own, so that a saw cut keeps its edge;
     * 180: smooth everywhere. */
    double crease_deg;
    /* Each pass replaces every shading normal by the mean of itself and its neighbours. Surfaces from CT
     * carry the steps of the slices; a few passes take them out of the light. */
    int normal_passes;
    /* Passes of the same mean over the light that reaches each vertex: the spread of red light under the
     * skin. */
    int scatter_passes;
} model_params;

model_params model_params_skin(void); /* smooth, 3 passes, 5 passes */
model_params model_params_bone(void); /* crease 50 degrees, 2 passes, 1 pass */

typedef struct model model;

/* Copies what it needs from the surface; free with model_free. Refuses (ERR_GEOMETRY) what surface_check
 * refuses. */
bool model_create(studio *s, const surface *from, const model_params *params, model **out, err *e) MUST_CHECK;
void model_free(model **m);                 /* idempotent; before studio_close */
int32_t model_vertex_count(const model *m); /* of the surface it was made from */

#ifdef __cplusplus
}
#endif
