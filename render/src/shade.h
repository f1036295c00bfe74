/* Private: the light that leaves each vertex of a layer towards the viewer. Worked out per vertex and not per
 * pixel: on a scanned head most triangles cover a few pixels, and a software driver shades sixteen for each.
 */
#pragma once
#include "render/picture.h"

typedef struct shading {
    float *light; /* [4*vertex_count] what multiplies the surface's colour, linear; 4th: how hollow, 0 open to
                     1 */
    float *spark; /* [4*vertex_count] what is added to it: highlights and outline light; 4th: opacity */
} shading;

shading shade(const layer *l, const camera *c);
void shading_free(shading *s);
