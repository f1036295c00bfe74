/* comparison: the standard set of pictures of a plan: before | predicted, displacement maps, bones through
 * the skin.
 *
 * Writes into a folder, all after all have been drawn, so that a refusal writes none:
 *   before_after_front.png  _left  _right  _three_quarter     skin, before | predicted
 *   heat_front.png          _left  _three_quarter             displacement of the predicted skin, one range
 * for all bones_front.png         _left  _three_quarter             segments through clear skin, before |
 * planned overview.png                                              three skin views and the bones, before
 * over after Without skin the skin and heat pictures are left out, without parts the bone pictures; what was
 * written is in the result. One camera per view serves before and after; all are orthographic with a true
 * scale bar. */
#pragma once
#include "render/picture.h"
#include "render/label.h"
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct comparison_part { /* a segment, or teeth that ride on it */
    const surface *bone;
    rigid before, after;
    material kind; /* MATERIAL_BONE or MATERIAL_TOOTH */
    double rgb[3];
    const char *name; /* for the legend; NULL: not in it */
} comparison_part;

typedef struct comparison {
    const char *case_name, *plan_text;       /* title strip; plan_text may be NULL */
    const char *case_hash;                   /* into the files' text chunks; may be NULL */
    const surface *skin_before, *skin_after; /* both or neither NULL; the same triangles;
                                                shown in their colours if they have any */
    const double
        *displacement_mm; /* [vertex_count] on skin_after, NaN: no data; NULL: distance from skin_before */
    const comparison_part *parts;
    int part_count;
    head_frame frame;
    /* radius 0: each view is fitted to all that is drawn. Else the sphere to show, e.g. the face. */
    double region_centre[3], region_radius_mm;
} comparison;

typedef struct comparison_params {
    int tile_width, tile_height; /* even; pixels of each half of a before | after picture */
    int light_directions;                     /* see picture_bake */
    double skin_opacity;                      /* over the bones */
    double heat_high_mm;                      /* end of the colour range; 0: from the data, rounded up */
    label_fonts fonts;
} comparison_params;

comparison_params comparison_params_default(void); /* 900 x 1000, 64, 0.25, from the data, DejaVu Sans */

enum { COMPARISON_PICTURES_MAX = 16, COMPARISON_NAME_SIZE = 64 };

typedef struct comparison_result {
    int count;
    char name[COMPARISON_PICTURES_MAX][COMPARISON_NAME_SIZE]; /* files, in the order written */
    double heat_low_mm, heat_high_mm;                         /* the range of the colour bar */
    double largest_mm, median_mm; /* of the displacement, per vertex, over vertices with data */
} comparison_result;

/* The fixed colour of each segment: cranium ivory, the others told apart by hue and lightness. */
void comparison_segment_color(segment_id id, double rgb[3]);

/* `folder` must exist. result may be NULL. Refuses what studio_open, picture_render and png_file_write
 * refuse; (ERR_USAGE) nothing to draw; (ERR_GEOMETRY) skins of different triangles, negative displacements.
 */
bool comparison_write(const comparison *c, const comparison_params *params, const char *folder,
                      comparison_result *result, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
