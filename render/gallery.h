/* gallery: the pictures of a patient and a plan. Surfaces are loaded and lit when a picture first needs them
 * and kept for the next one. */
#pragma once
#include "render/label.h"
#include "render/panel.h"
#include "render/picture.h"
#include "geometry/landmarks.h"
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct subject_part { /* a segment, or teeth that ride on it */
    const surface *bone;
    rigid before, after;
    material kind; /* MATERIAL_BONE or MATERIAL_TOOTH */
    double rgb[3];
    const char *name;  /* for the legend; NULL: not in it */
    const double *rim; /* [6*rim_count] pieces of the lines where it was cut, at rest; may be NULL */
    int rim_count;
} subject_part;

typedef struct subject {
    const char *case_name, *plan_text;       /* title strip; plan_text may be NULL */
    const char *case_hash;                   /* into the files' text chunks; may be NULL */
    const surface *skin_before, *skin_after; /* both or neither NULL; the same triangles; shown in their
                                                colours if they have any */
    /* [vertex_count] for the maps, NaN: no data, NULL: not known; displacement: NULL: distance from
     * skin_before */
    const double *displacement_mm, *signed_mm, *stretch_percent;
    const char *signed_caption; /* of the colour bar */
    const subject_part *parts;
    int part_count;
    const landmarks *before, *after; /* same labels and order; may be NULL */
    head_frame frame;
} subject;

typedef struct sheet { /* panels side by side, row by row, under a title */
    const char *title; /* NULL: no strip */
    const panel *panels;
    int panel_count, columns;
    int width, height; /* pixels of the whole */
} sheet;

typedef struct gallery_style {
    int light_directions;                               /* see picture_bake */
    double skin_opacity;                                /* over the bones */
    double displacement_mm, signed_mm, stretch_percent; /* end of each colour range; 0: from the data, rounded
                                                           up. That of signed_mm is symmetric. */
    double zoom;                                        /* 1: the face fills the picture */
    const char *centre;                                 /* label of the landmark to be in the middle; NULL: the face */
    double perspective_deg; /* full vertical angle; 0: orthographic, with a true scale bar */
    char sex;               /* 'f' or 'm': norms beside the cephalometry; 0: none */
    bool labels;
    label_fonts fonts;
} gallery_style;

gallery_style gallery_style_default(void); /* 64, 0.25, from the data, 1, orthographic, no norms, labels, DejaVu Sans */

typedef struct gallery gallery;

/* Borrows subject and style until it is closed. Refuses what studio_open refuses, (ERR_USAGE) nothing to draw
 * and a centre that is not among the landmarks, (ERR_GEOMETRY) skins of different triangles. */
bool gallery_open(const subject *s, const gallery_style *style, gallery **out, err *e) MUST_CHECK;
void gallery_close(gallery **g); /* idempotent */

/* Can this be drawn of the subject? Else *e (ERR_USAGE) names what it lacks. */
bool gallery_can_show(const gallery *g, panel_show show, err *e) MUST_CHECK;
/* *out is created; the caller frees it. Refuses what gallery_can_show, picture_render and pen_open refuse,
 * and (ERR_USAGE) sizes that leave a panel less than 64 pixels. */
bool gallery_draw(gallery *g, const sheet *what, image *out, err *e) MUST_CHECK;
/* Draws, and writes a PNG file with case, plan, hash, what is shown and the renderer in its text chunks. */
bool gallery_write(gallery *g, const sheet *what, const char *path, err *e) MUST_CHECK;

typedef struct gallery_range {
    double high;            /* end of the colour range */
    double largest, median; /* over vertices with data; of the absolute value */
} gallery_range;

/* Of a map that can be shown. */
gallery_range gallery_map_range(const gallery *g, panel_show show);

#ifdef __cplusplus
}
#endif
