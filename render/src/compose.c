#include "render/compose.h"
#include <assert.h>
#include <stddef.h>

static const double gap_rgb[3] = {1, 1, 1}, strip_rgb[3] = {0.165, 0.215, 0.275};
static const double strip_ink[3] = {0.97, 0.98, 0.99}, strip_faint[3] = {0.76, 0.81, 0.87};
static const double caption_ink[3] = {0.13, 0.16, 0.20};

compose_params compose_params_default(void)
{
    return (compose_params){.columns = 2, .gap = 6, .font_size = 22, .fonts = label_fonts_default()};
}

int compose_title_height(const compose_params *params) { return params->title ? (int)(2.4 * params->font_size) : 0; }

void compose_tile_size(int count, const compose_params *params, int *width, int *height)
{
    int columns = count < params->columns ? count : params->columns, rows = (count + columns - 1) / columns;
    *width = (params->sheet_width - (columns - 1) * params->gap) / columns;
    *height = (params->sheet_height - compose_title_height(params) - (rows - 1) * params->gap) / rows;
}

bool compose_sheet(const compose_tile *tiles, int count, const compose_params *params, image *out, err *e)
{
    assert(count > 0 && params->columns > 0 && params->gap >= 0);
    int w = tiles[0].picture->width, h = tiles[0].picture->height, title = compose_title_height(params);
    for (int i = 1; i < count; i++)
        if (tiles[i].picture->width != w || tiles[i].picture->height != h)
            return err_set(e, ERR_USAGE, "pictures of different sizes on one sheet (%d x %d and %d x %d)", w, h,
                           tiles[i].picture->width, tiles[i].picture->height);
    int columns = count < params->columns ? count : params->columns, rows = (count + columns - 1) / columns;
    int64_t width = (int64_t)columns * (w + params->gap) - params->gap;
    int64_t height = title + (int64_t)rows * (h + params->gap) - params->gap;
    if (params->sheet_width) width = params->sheet_width;
    if (params->sheet_height) height = params->sheet_height;
    if (width > IMAGE_SIZE_MAX || height > IMAGE_SIZE_MAX)
        return err_set(e, ERR_USAGE, "a sheet of %lld x %lld pixels: at most %d along a side", (long long)width,
                       (long long)height, IMAGE_SIZE_MAX);
    image sheet = image_new((int)width, (int)height);
    image_fill(&sheet, gap_rgb);
    for (int i = 0; i < count; i++)
        image_paste(&sheet, tiles[i].picture, i % columns * (w + params->gap), title + i / columns * (h + params->gap));
    pen *p = NULL;
    if (!pen_open(&sheet, &params->fonts, &p, e)) {
        image_free(&sheet);
        return false;
    }
    double size = params->font_size;
    for (int i = 0; i < count; i++)
        if (tiles[i].caption)
            pen_text(p, i % columns * (w + params->gap) + 0.9 * size,
                     title + i / columns * (h + params->gap) + 1.6 * size, LABEL_LEFT, size, true, caption_ink,
                     tiles[i].caption);
    if (params->title) {
        pen_box(p, 0, 0, sheet.width, title, strip_rgb, 1);
        pen_text(p, 0.9 * size, 0.66 * title, LABEL_LEFT, 1.15 * size, true, strip_ink, params->title);
        /* A long subtitle shrinks; it is left out where it would be unreadable. */
        double used = 0.9 * size + pen_text_width(p, 1.15 * size, true, params->title) + 2 * size;
        if (params->subtitle) {
            double small = 0.85 * size, free_width = sheet.width - 0.9 * size - used;
            double wide = pen_text_width(p, small, false, params->subtitle);
            if (wide > free_width && free_width > 0) small *= free_width / wide;
            if (small >= 0.4 * size)
                pen_text(p, sheet.width - 0.9 * size, 0.64 * title, LABEL_RIGHT, small, false, strip_faint,
                         params->subtitle);
        }
    }
    pen_close(&p);
    *out = sheet;
    return true;
}
