/* The values that a picture shows in colours, and the range of the colours. */
#include "render/src/gallery.h"
#include "geometry/mem.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static const double *map_values(const gallery *g, panel_show show)
{
    const subject *s = g->s;
    if (show == SHOW_DISPLACEMENT) return g->displacement;
    return show == SHOW_SIGNED ? s->signed_mm : show == SHOW_STRETCH ? s->stretch_percent : NULL;
}

gallery_range gallery_map_range(const gallery *g, panel_show show)
{
    const double *value = map_values(g, show), least = 1e-3;
    assert(value);
    int32_t n = g->s->skin_after->vertex_count, known = 0;
    double *sorted = NEW_ARRAY(double, n);
    for (int32_t v = 0; v < n; v++)
        if (!isnan(value[v])) sorted[known++] = fabs(value[v]);
    qsort(sorted, (size_t)known, sizeof *sorted, compare_doubles);
    gallery_range r = {.largest = known ? sorted[known - 1] : 0, .median = known ? sorted[known / 2] : 0};
    /* a few vertices at the rim of the lips may stretch without end */
    double high = show == SHOW_STRETCH && known ? sorted[(int64_t)known * 99 / 100] : r.largest;
    double asked = show == SHOW_DISPLACEMENT ? g->style->displacement_mm
                   : show == SHOW_SIGNED     ? g->style->signed_mm
                                             : g->style->stretch_percent;
    /* Noise of a fraction of a micrometre is not worth a colour range. */
    r.high = asked > 0 ? asked : colormap_nice_ceiling(high > least ? high : 1);
    free(sorted);
    return r;
}

const double *gallery_map(const gallery *g, panel_show show, label_map *bar)
{
    double high = gallery_map_range(g, show).high;
    *bar = (label_map){.map = COLORMAP_VIRIDIS, .high = high, .fade_end = 0.2 * high};
    material_color(MATERIAL_SKIN, bar->fade_rgb);
    if (show == SHOW_DISPLACEMENT) bar->caption = "displacement, mm";
    if (show == SHOW_STRETCH) bar->caption = "stretch, %";
    if (show == SHOW_SIGNED) {
        bar->map = COLORMAP_COOLWARM;
        bar->low = bar->fade_end = -high;
        bar->caption = g->s->signed_caption ? g->s->signed_caption : "outward +, inward -, mm";
    }
    return map_values(g, show);
}
