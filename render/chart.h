/* chart: a plane of two numbers, coloured by kind on a regular grid of nodes.
 *
 * Kinds have a colour, a pattern and a letter, so that they are told apart without colour too. Where neighbours have
 * different ranks the line between them goes through the given crossings; kinds of one rank part half way. */
#pragma once
#include "render/image.h"
#include "render/label.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct chart_axis {
    const char *title; /* with the unit */
    double low, step;  /* of the first node, and from node to node */
    int count;         /* >= 2 nodes */
} chart_axis;

typedef enum chart_pattern { CHART_PLAIN, CHART_DOTS, CHART_STRIPES } chart_pattern;

typedef struct chart_kind {
    double rgb[3];
    chart_pattern pattern;
    int rank;         /* of the lines between kinds: the higher, the heavier */
    char letter[4];   /* written into its patches and into the legend; "" none */
    const char *text; /* in the legend; NULL: left out there */
} chart_kind;

typedef enum chart_symbol { CHART_CROSS, CHART_RING, CHART_DOT } chart_symbol;

typedef struct chart_mark {
    double x, y;
    chart_symbol symbol;
    const char *text; /* in the legend; NULL: as the one before */
} chart_mark;

typedef struct chart {
    const char *title, *subtitle; /* subtitle may be NULL */
    chart_axis x, y;
    const int32_t *kind;       /* [x.count*y.count] number of the kind, x fastest */
    const double *crossing[2]; /* NULL or [x.count*y.count] along x, along y: share of the way to the next node at which
                                  the rank changes; read only where it does */
    const uint8_t *veiled;     /* NULL or [x.count*y.count] 1: drawn under a grey net */
    const char *veil_text;     /* in the legend */
    const chart_kind *kinds;
    int kind_count;
    const chart_mark *marks;
    int mark_count;
    const char *const *notes; /* lines below the legend */
    int note_count;
} chart;

/* A picture `width` pixels wide; its height follows from the axes, drawn to the same scale where their units agree
 * (same_scale). *out is created; the caller frees it. Refuses (ERR_RESOURCE) a missing font. */
bool chart_draw(const chart *c, int width, bool same_scale, image *out, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
