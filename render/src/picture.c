#include "render/picture.h"
#include "render/src/draw.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include <stdlib.h>
#include <string.h>

layer layer_default(model *shape, material kind)
{
    layer l = {.shape = shape, .kind = kind, .high = 1, .opacity = 1, .move = rigid_identity()};
    material_color(kind, l.rgb);
    return l;
}

picture_style picture_style_default(void)
{
    return (picture_style){.width = 900,
                           .height = 1000,
                           .background_top = {0.745, 0.790, 0.840},
                           .background_bottom = {0.945, 0.955, 0.965},
                           .exposure = 1};
}

static bool check(const picture *p, const picture_style *style, err *e)
{
    if (style->width < 16 || style->height < 16 || style->width > IMAGE_SIZE_MAX || style->height > IMAGE_SIZE_MAX)
        return err_set(e, ERR_USAGE, "a picture of %d x %d pixels: sides must be 16 to %d", style->width, style->height,
                       IMAGE_SIZE_MAX);
    if (!(style->exposure > 0)) return err_set(e, ERR_USAGE, "exposure must be > 0, got %g", style->exposure);
    for (int i = 0; i < p->layer_count; i++) {
        const layer *l = p->layers + i;
        if (!(l->opacity > 0 && l->opacity <= 1))
            return err_set(e, ERR_USAGE, "layer %d: opacity must be in (0, 1], got %g", i, l->opacity);
        if (l->scalar && !(l->high > l->low))
            return err_set(e, ERR_USAGE, "layer %d: the colour range %g to %g is empty", i, l->low, l->high);
    }
    return true;
}

static void finish(studio *s, const picture_style *style, image *out)
{
    const gl *g = &s->gl;
    const canvas *c = &s->sheet;
    int w = style->width, h = style->height;
    g->BindFramebuffer(GL_READ_FRAMEBUFFER, c->many);
    g->BindFramebuffer(GL_DRAW_FRAMEBUFFER, c->one);
    g->BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    g->BindFramebuffer(GL_FRAMEBUFFER, c->final);
    g->Viewport(0, 0, style->width, style->height);
    g->Disable(GL_DEPTH_TEST);
    g->UseProgram(s->finish);
    set_float(g, s->finish, "height", style->height);
    set_float(g, s->finish, "exposure", style->exposure);
    set_rgb(g, s->finish, "top", style->background_top, false);
    set_rgb(g, s->finish, "bottom", style->background_bottom, false);
    g->BindTexture(GL_TEXTURE_2D, c->one_colour);
    g->BindVertexArray(s->empty_array);
    g->DrawArrays(GL_TRIANGLES, 0, 3);
    *out = image_new(style->width, style->height);
    size_t stride = 4 * (size_t)style->width;
    g->ReadPixels(0, 0, style->width, style->height, GL_RGBA, GL_UNSIGNED_BYTE, out->rgba);
    uint8_t *row = NEW_ARRAY(uint8_t, stride);
    for (int y = 0; y < style->height / 2; y++) { /* GL counts rows from below */
        uint8_t *a = image_pixel(out, 0, y), *b = image_pixel(out, 0, style->height - 1 - y);
        memcpy(row, a, stride);
        memcpy(a, b, stride);
        memcpy(b, row, stride);
    }
    free(row);
}

static bool use_canvas(studio *s, const picture_style *style, err *e)
{
    canvas *c = &s->sheet;
    if (c->width != style->width || c->height != style->height) {
        if (c->width) canvas_close(&s->gl, c);
        bool ok = canvas_open(&s->gl, style->width, style->height, c, e);
        if (!ok) {
            canvas_close(&s->gl, c);
            return false;
        }
    }
    s->gl.BindFramebuffer(GL_FRAMEBUFFER, c->many);
    return true;
}

bool picture_render(studio *s, const picture *p, const picture_style *style, image *out, uint8_t *mark_seen, err *e)
{
    if (!check(p, style, e) || !studio_use(s, e) || !use_canvas(s, style, e)) return false;
    const gl *g = &s->gl;
    int w = style->width, h = style->height;
    image drawn = {0};
    g->Viewport(0, 0, w, h);
    g->Enable(GL_DEPTH_TEST);
    g->Enable(GL_PROGRAM_POINT_SIZE);
    g->DepthMask(GL_TRUE);
    g->ColorMask(true, true, true, true);
    g->ClearColor(0, 0, 0, 0);
    g->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_opaque_layers(s, p, w, h);
    draw_extras(s, p, w, h, false);
    draw_clear_layers(s, p, w, h);
    if (mark_seen) look_for_marks(s, p, w, h, mark_seen);
    g->BindFramebuffer(GL_FRAMEBUFFER, s->sheet.many);
    draw_extras(s, p, w, h, true);
    finish(s, style, &drawn);
    g->BindVertexArray(0);
    g->BindFramebuffer(GL_FRAMEBUFFER, 0);
    if (studio_check(s, "drawing", e)) {
        *out = drawn;
        return true;
    }
    image_free(&drawn);
    return false;
}
