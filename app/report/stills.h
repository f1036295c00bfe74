/* report_stills: the pictures of a report, for paper and for browsers without WebGL. */
#pragma once
#include "app/planner/predict/outcome_read.h"
#include "render/panel.h"

typedef struct report_still {
    const char *file, *title;
    int panel_count; /* side by side */
    panel panels[2];
} report_still;

extern const report_still report_stills[];
extern const int report_still_count;

/* Draws them into `folder`, which must exist. They are drawn anew because the pictures of an outcome carry the names of
 * case and plan; these do only if `names`. */
bool report_stills_draw(const outcome_shapes *o, bool names, const char *folder, err *e) MUST_CHECK;
