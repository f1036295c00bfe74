/* Private: who draws a panel. */
#pragma once
#include "render/src/gallery.h"

/* One panel, with its labels but the caption. *out is created; the caller frees it. */
bool panel_draw(gallery *g, const panel *p, int width, int height, image *out, err *e) MUST_CHECK;
