/* picture: draws layers (models with a material), marks and strokes into an image.
 *
 * Light: a fixed studio (sky, key from the upper left, fill, two rim lights) that turns with the camera. What
 * reaches each vertex is precomputed by picture_bake: the part of the sky that the layers hide from it, kept
 * as a transfer vector of 9 spherical harmonics (P.-P. Sloan, J. Kautz, J. Snyder, "Precomputed radiance
 * transfer", SIGGRAPH 2002, section 4: diffuse, shadowed). Red light spreads farther over the surface than
 * blue: the soft look of skin.
 *
 * Same input, same bytes, on one machine and Mesa version, for any number of threads. */
#pragma once
#include "render/camera.h"
#include "render/colormap.h"
#include "render/image.h"
#include "render/studio.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum material { MATERIAL_SKIN, MATERIAL_BONE, MATERIAL_TOOTH, MATERIAL_PLAIN } material;

void material_color(material m, double rgb[3]); /* its usual colour, sRGB 0..1 */

typedef struct layer {
    model *shape;              /* borrowed; picture_bake changes its light */
    material kind;             /* how it shines */
    double rgb[3];             /* sRGB 0..1 */
    const uint8_t *vertex_rgb; /* [3*vertex_count] sRGB, replaces rgb; may be NULL */
    const double *scalar;      /* [vertex_count], shown through map over [low, high]; may be NULL; NaN: no data */
    colormap map;
    double low, high;
    double fade_end;      /* from low to here rgb passes into the map; <= low: the map everywhere */
    double opacity;       /* 1: opaque; below 1 only the front-most sheet of the layer is seen */
    bool over;            /* clear layers: an outline seen through all other layers, not only where it lies in front */
    const double *weight; /* [vertex_count] 0..1, times the opacity of a clear layer; may be NULL */
    rigid move;
} layer;

layer layer_default(model *shape, material kind); /* its usual colour, opaque, not moved */

typedef struct mark { /* a ball, e.g. a landmark */
    double xyz[3], radius_mm, rgb[3];
    bool on_top; /* seen through everything */
} mark;

typedef struct stroke { /* a polyline, e.g. the course of a cut */
    const double *xyz;  /* [3*count] mm */
    int count;
    double width_mm, rgb[3];
    bool closed, on_top;
} stroke;

typedef struct picture {
    const layer *layers; /* translucent layers are drawn in the given order after all opaque ones */
    int layer_count;
    const mark *marks;
    int mark_count;
    const stroke *strokes;
    int stroke_count;
    camera view;
} picture;

typedef struct picture_style {
    int width, height;                              /* pixels, of 4 samples each */
    double background_top[3], background_bottom[3]; /* sRGB */
    double exposure;                                /* 1: usual */
} picture_style;

picture_style picture_style_default(void); /* 900 x 1000, light grey-blue, 1 */

/* Precomputes the light of every layer's model with all the given layers in place. The result stays with the
 * models until the next bake; a model never baked is lit without shadows. directions: 32..1024, 96 is usual.
 */
bool picture_bake(const layer *layers, int layer_count, int directions, err *e) MUST_CHECK;

/* *out is created; the caller frees it. mark_seen[mark_count] (may be NULL) tells which marks are not hidden.
 * Refuses (ERR_USAGE) sizes outside 16..IMAGE_SIZE_MAX, opacities outside (0, 1], an empty colour
 * range; (ERR_RESOURCE) a frame buffer that cannot be made. */
bool picture_render(studio *s, const picture *p, const picture_style *style, image *out, uint8_t *mark_seen,
                    err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
