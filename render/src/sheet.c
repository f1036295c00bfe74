/* Panels side by side, as an image or a file. */
#include "render/compose.h"
#include "render/png_file.h"
#include "render/src/gallery.h"
#include "render/src/panel_draw.h"
#include "geometry/mem.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool gallery_draw(gallery *g, const sheet *what, image *out, err *e)
{
    assert(what->panel_count > 0 && what->columns > 0);
    int columns = what->panel_count < what->columns ? what->panel_count : what->columns;
    compose_params p = compose_params_default();
    p.columns = columns;
    p.fonts = g->style->fonts;
    p.font_size = fmax(9, what->height / 52.0);
    char title[300];
    snprintf(title, sizeof title, "%s%s%s", g->s->case_name, *g->s->case_name && what->title ? "   " : "",
             what->title ? what->title : "");
    p.title = g->style->labels ? title : NULL;
    p.subtitle = g->s->plan_text;
    p.sheet_width = what->width;
    p.sheet_height = what->height;
    int width, height;
    compose_tile_size(what->panel_count, &p, &width, &height);
    if (width < 64 || height < 64)
        return err_set(e, ERR_USAGE, "%d panels do not fit into a picture of %d x %d pixels", what->panel_count,
                       what->width, what->height);
    compose_tile *tile = NEW_ARRAY(compose_tile, what->panel_count);
    image *im = NEW_ARRAY(image, what->panel_count);
    bool ok = true;
    for (int i = 0; ok && i < what->panel_count; i++) {
        ok = panel_draw(g, &what->panels[i], width, height, &im[i], e);
        tile[i] = (compose_tile){&im[i], g->style->labels ? what->panels[i].caption : NULL};
    }
    ok = ok && compose_sheet(tile, what->panel_count, &p, out, e);
    for (int i = 0; i < what->panel_count; i++) image_free(&im[i]);
    free(im);
    free(tile);
    return ok;
}

bool gallery_write(gallery *g, const sheet *what, const char *path, err *e)
{
    const subject *s = g->s;
    image im = {0};
    if (!gallery_draw(g, what, &im, e)) return false;
    png_note notes[6] = {
        {"Software", "gnathos " GNATHOS_VERSION}, {"Renderer", studio_description(g->room)}, {"Case", s->case_name}};
    int count = 3;
    if (what->title) notes[count++] = (png_note){"Title", what->title};
    if (s->plan_text) notes[count++] = (png_note){"Plan", s->plan_text};
    if (s->case_hash) notes[count++] = (png_note){"Case hash", s->case_hash};
    bool ok = png_file_write(&im, notes, count, path, e);
    image_free(&im);
    return ok;
}
