/* chart_plane: the coloured plane of a chart, and the swatches of its legend. Private. */
#pragma once
#include "render/chart.h"

/* Draws the plane into the rectangle (left, top, width, height) of the image; size: of the text, for lines and
 * patterns. */
void chart_plane_draw(const chart *c, int left, int top, int width, int height, double size, image *to);
/* A square of one kind with its corner at (x, y). */
void chart_plane_swatch(const chart_kind *kind, int x, int y, int side, double size, image *to);
static inline int64_t chart_node(const chart *c, int i, int k) { return (int64_t)k * c->x.count + i; }
