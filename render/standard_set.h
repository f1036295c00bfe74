/* standard_set: the pictures that every outcome gets. */
#pragma once
#include "render/gallery.h"
#ifdef __cplusplus
extern "C" {
#endif

enum { STANDARD_PANELS_MAX = 8 };

typedef struct standard_picture {
    const char *file, *title;
    int panel_count, columns;
    panel panels[STANDARD_PANELS_MAX];
} standard_picture;

/* overview, before_after_VIEW, bones_VIEW, heat, contour, tracing, in this order. */
extern const standard_picture standard_set[];
extern const int standard_set_count;

/* Writes those that the subject has data for into `folder`, which must exist. written[standard_set_count]
 * (may be NULL) tells which. Refuses what gallery_write refuses. */
bool standard_set_write(gallery *g, int width, int height, const char *folder, bool *written, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
