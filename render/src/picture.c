#include "render/picture.h"
#include "render/src/canvas.h"
#include "render/src/light.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

typedef struct look {
    double rgb[3];             /* sRGB */
    float scatter[3];          /* share of scattered light, red green blue */
    float gloss, shine, sheen; /* sharpness and strength of the highlight, strength of the outline light */
} look;

static const look looks[] = {
    [MATERIAL_SKIN] = {{0.885, 0.715, 0.620}, {0.85f, 0.40f, 0.15f}, 18, 1.6f, 0.10f},
    [MATERIAL_BONE] = {{0.905, 0.865, 0.765}, {0.35f, 0.30f, 0.25f}, 26, 1.4f, 0.05f},
    [MATERIAL_TOOTH] = {{0.965, 0.955, 0.925}, {0.60f, 0.60f, 0.60f}, 70, 1.20f, 0.05f},
    [MATERIAL_PLAIN] = {{0.70, 0.72, 0.75}, {0, 0, 0}, 26, 0.50f, 0.04f},
};

void material_color(material m, double rgb[3])
{
    vec_copy(looks[m].rgb, rgb);
}

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
                           .supersample = 2,
                           .background_top = {0.745, 0.790, 0.840},
                           .background_bottom = {0.945, 0.955, 0.965},
                           .exposure = 1};
}

static bool check(const picture *p, const picture_style *style, err *e)
{
    if (style->supersample < 1 || style->supersample > 3)
        return err_set(e, ERR_USAGE, "supersampling %d: 1, 2 or 3 are possible", style->supersample);
    int most = IMAGE_SIZE_MAX / style->supersample;
    if (style->width < 16 || style->height < 16 || style->width > most || style->height > most)
        return err_set(e, ERR_USAGE, "a picture of %d x %d pixels: sides must be 16 to %d", style->width,
                       style->height, most);
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

/* World to clip, column-major, seen `toward_mm` nearer than it is (0 for surfaces; lines lie a little above).
 */
static void clip_matrix(const camera *c, int width, int height, double toward_mm, float m[16])
{
    double half_h = c->half_height_mm, half_w = half_h * width / height;
    double row[4][4] = {{0}};
    for (int k = 0; k < 3; k++) {
        row[0][k] = c->right[k] / half_w;
        row[1][k] = c->up[k] / half_h;
        row[2][k] = -c->back[k] / c->depth_mm;
    }
    row[0][3] = -vec_dot(c->right, c->target) / half_w;
    row[1][3] = -vec_dot(c->up, c->target) / half_h;
    row[2][3] = (vec_dot(c->back, c->target) - toward_mm) / c->depth_mm;
    row[3][3] = 1;
    if (c->eye_mm > 0) {
        /* w = 1 - near/eye; depth is made hyperbolic between eye -+ depth_mm */
        double a = c->eye_mm - c->depth_mm, b = c->eye_mm + c->depth_mm;
        for (int k = 0; k < 4; k++) row[3][k] = 0;
        for (int k = 0; k < 3; k++) row[3][k] = -c->back[k] / c->eye_mm;
        row[3][3] = 1 + vec_dot(c->back, c->target) / c->eye_mm;
        for (int k = 0; k < 4; k++) row[2][k] = (b + a) / (b - a) * row[3][k];
        row[2][3] -= 2 * a * b / ((b - a) * c->eye_mm) + toward_mm / c->depth_mm;
    }
    for (int r = 0; r < 4; r++)
        for (int k = 0; k < 4; k++) m[4 * k + r] = (float)row[r][k];
}

static void uniform_rgb(const gl *g, GLuint program, const char *name, const double srgb[3], bool to_linear)
{
    float c[3];
    for (int k = 0; k < 3; k++) c[k] = (float)(to_linear ? colormap_linear(srgb[k]) : srgb[k]);
    g->Uniform3fv(g->GetUniformLocation(program, name), 1, c);
}

static void uniform_float(const gl *g, GLuint program, const char *name, double x)
{
    g->Uniform1f(g->GetUniformLocation(program, name), (float)x);
}

typedef struct loaded { /* what a layer needs besides its model */
    GLuint colour_buffer, value_buffer, map;
} loaded;

static GLuint load_floats(const gl *g, const float *values, size_t count)
{
    GLuint buffer;
    g->GenBuffers(1, &buffer);
    g->BindBuffer(GL_ARRAY_BUFFER, buffer);
    g->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *values), values, GL_STREAM_DRAW);
    return buffer;
}

static GLuint load_map(const gl *g, colormap map)
{
    /* Linear light, so that colours mix with the light like any other albedo. */
    const uint8_t *table = colormap_table(map);
    float texel[3 * COLORMAP_SIZE];
    for (int i = 0; i < 3 * COLORMAP_SIZE; i++) texel[i] = (float)colormap_linear(table[i] / 255.0);
    GLuint texture;
    g->GenTextures(1, &texture);
    g->BindTexture(GL_TEXTURE_2D, texture);
    g->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, COLORMAP_SIZE, 1, 0, GL_RGB, GL_FLOAT, texel);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static loaded load_layer(const gl *g, const layer *l)
{
    const model *m = l->shape;
    loaded out = {0};
    float *values = NEW_ARRAY(float, 3 * (size_t)m->vertex_count);
    if (l->vertex_rgb) {
        for (int32_t v = 0; v < m->vertex_count; v++)
            for (size_t k = 0; k < 3; k++)
                values[3 * (size_t)v + k] =
                    (float)colormap_linear(l->vertex_rgb[3 * (size_t)m->source[v] + k] / 255.0);
        out.colour_buffer = load_floats(g, values, 3 * (size_t)m->vertex_count);
    }
    if (l->scalar) {
        for (int32_t v = 0; v < m->vertex_count; v++) {
            double x = l->scalar[m->source[v]];
            bool known = !isnan(x);
            values[2 * (size_t)v] = known ? (float)((x - l->low) / (l->high - l->low)) : 0;
            values[2 * (size_t)v + 1] = known;
        }
        out.value_buffer = load_floats(g, values, 2 * (size_t)m->vertex_count);
        out.map = load_map(g, l->map);
    }
    free(values);
    return out;
}

static void unload_layer(const gl *g, loaded *x)
{
    g->DeleteBuffers(2, (GLuint[2]){x->colour_buffer, x->value_buffer});
    g->DeleteTextures(1, &x->map);
}

static void set_attribute(const gl *g, GLuint place, int size, GLuint buffer, double x, double y, double z)
{
    if (buffer) {
        g->BindBuffer(GL_ARRAY_BUFFER, buffer);
        g->EnableVertexAttribArray(place);
        g->VertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, 0, NULL);
    } else {
        g->DisableVertexAttribArray(place);
        g->VertexAttrib3f(place, (float)x, (float)y, (float)z);
    }
}

static void set_move(const gl *g, GLuint program, const rigid *a)
{
    float move[16] = {0};
    for (int col = 0; col < 3; col++) {
        for (int r = 0; r < 3; r++) move[4 * col + r] = (float)a->r[3 * r + col];
        move[12 + col] = (float)a->t[col];
    }
    move[15] = 1;
    g->UniformMatrix4fv(g->GetUniformLocation(program, "move"), 1, GL_FALSE, move);
}

static void draw_depth(studio *s, const layer *l)
{
    const gl *g = &s->gl;
    g->UseProgram(s->ribbon);
    set_move(g, s->ribbon, &l->move);
    g->BindVertexArray(l->shape->array);
    g->DrawElements(GL_TRIANGLES, 3 * l->shape->triangle_count, GL_UNSIGNED_INT, NULL);
}

static void draw_layer(studio *s, const layer *l, const loaded *x, const camera *c)
{
    const gl *g = &s->gl;
    const look *k = looks + l->kind;
    float light[3 * HARMONICS];
    lamps_project(c, &l->move, light);
    g->UseProgram(s->shade);
    set_move(g, s->shade, &l->move);
    g->Uniform3fv(g->GetUniformLocation(s->shade, "light"), HARMONICS, light);
    g->Uniform3fv(g->GetUniformLocation(s->shade, "scatter"), 1, k->scatter);
    uniform_float(g, s->shade, "gloss", (double)k->gloss);
    uniform_float(g, s->shade, "shine", l->scalar ? 0.3 * (double)k->shine : (double)k->shine);
    uniform_float(g, s->shade, "sheen", (double)k->sheen);
    uniform_float(g, s->shade, "opacity", l->opacity);
    uniform_float(g, s->shade, "use_map", l->scalar ? 1 : 0);
    uniform_float(g, s->shade, "fade", l->scalar ? (l->fade_end - l->low) / (l->high - l->low) : 0);
    g->BindTexture(GL_TEXTURE_2D, x->map);
    g->BindVertexArray(l->shape->array);
    set_attribute(g, 8, 3, x->colour_buffer, colormap_linear(l->rgb[0]), colormap_linear(l->rgb[1]),
                  colormap_linear(l->rgb[2]));
    set_attribute(g, 9, 2, x->value_buffer, 0, 1, 0);
    g->DrawElements(GL_TRIANGLES, 3 * l->shape->triangle_count, GL_UNSIGNED_INT, NULL);
}

static void color_writes(const gl *g, bool on)
{
    g->ColorMask(on, on, on, on);
}

static void draw_layers(studio *s, const picture *p, const loaded *x, const float clip[16])
{
    const gl *g = &s->gl;
    g->UseProgram(s->ribbon);
    g->UniformMatrix4fv(g->GetUniformLocation(s->ribbon, "to_clip"), 1, GL_FALSE, clip);
    int translucent = 0;
    g->Disable(GL_BLEND);
    g->DepthFunc(GL_LESS);
    for (int i = 0; i < p->layer_count; i++)
        if (p->layers[i].opacity >= 1) draw_layer(s, p->layers + i, x + i, &p->view);
    for (int i = 0; i < p->layer_count; i++) {
        if (p->layers[i].opacity >= 1) continue;
        color_writes(g, false);
        if (translucent++) { /* forget the depth of the translucent layer before */
            g->Clear(GL_DEPTH_BUFFER_BIT);
            for (int k = 0; k < p->layer_count; k++)
                if (p->layers[k].opacity >= 1) draw_depth(s, p->layers + k);
        }
        draw_depth(s, p->layers + i);
        color_writes(g, true);
        g->Enable(GL_BLEND);
        g->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        g->DepthFunc(GL_EQUAL);
        draw_layer(s, p->layers + i, x + i, &p->view);
        g->Disable(GL_BLEND);
        g->DepthFunc(GL_LESS);
    }
}

/* A ribbon that faces the viewer, six vertices a piece. */
static float *ribbon(const stroke *k, const camera *c, int pieces)
{
    float *out = NEW_ARRAY(float, 18 * (size_t)pieces);
    for (int i = 0; i < pieces; i++) {
        const double *a = k->xyz + 3 * i, *b = k->xyz + 3 * ((i + 1) % k->count);
        double along[3], side[3], toward[3];
        vec_copy(c->back, toward);
        if (c->eye_mm > 0) {
            double eye[3];
            vec_axpy(c->target, c->eye_mm, c->back, eye);
            vec_sub(eye, a, toward);
        }
        vec_sub(b, a, along);
        vec_cross(along, toward, side);
        vec_normalize(side);
        vec_scale(side, k->width_mm / 2, side);
        static const int end[6] = {0, 1, 1, 0, 1, 0}, sign[6] = {-1, -1, 1, -1, 1, 1};
        for (int q = 0; q < 6; q++)
            for (int d = 0; d < 3; d++)
                out[18 * i + 3 * q + d] = (float)((end[q] ? b : a)[d] + sign[q] * side[d]);
    }
    return out;
}

/* Draws vertices of 3 floats that live only for this call. */
static void draw_loose(const gl *g, GLenum kind, const float *xyz, int count)
{
    GLuint array, buffer;
    g->GenVertexArrays(1, &array);
    g->BindVertexArray(array);
    buffer = load_floats(g, xyz, 3 * (size_t)count);
    g->EnableVertexAttribArray(0);
    g->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    g->DrawArrays(kind, 0, count);
    g->BindVertexArray(0);
    g->DeleteVertexArrays(1, &array);
    g->DeleteBuffers(1, &buffer);
}

static void draw_balls(studio *s, const camera *c, int width, int height, const float *xyz, int count,
                       double radius_mm, const double rgb[3], double lift_mm, bool flat)
{
    const gl *g = &s->gl;
    float clip[16];
    clip_matrix(c, width, height, lift_mm, clip);
    g->UseProgram(s->ball);
    g->UniformMatrix4fv(g->GetUniformLocation(s->ball, "to_clip"), 1, GL_FALSE, clip);
    uniform_float(g, s->ball, "size", 2 * radius_mm * camera_scale(c, height));
    uniform_float(g, s->ball, "flat_shade", flat);
    uniform_rgb(g, s->ball, "colour", rgb, true);
    draw_loose(g, GL_POINTS, xyz, count);
}

/* Cut lines lie on the bone: seen this much nearer, they do not sink into it. */
static const double stroke_lift_mm = 0.8;

static void draw_extras(studio *s, const picture *p, int width, int height, bool on_top)
{
    const gl *g = &s->gl;
    if (on_top) g->Disable(GL_DEPTH_TEST);
    for (int i = 0; i < p->stroke_count; i++) {
        const stroke *k = p->strokes + i;
        int pieces = k->closed ? k->count : k->count - 1;
        if (k->on_top != on_top || pieces < 1) continue;
        float clip[16], *points = ribbon(k, &p->view, pieces),
                        *joint = NEW_ARRAY(float, 3 * (size_t)k->count);
        clip_matrix(&p->view, width, height, stroke_lift_mm, clip);
        rigid stay = rigid_identity();
        g->UseProgram(s->ribbon);
        set_move(g, s->ribbon, &stay);
        g->UniformMatrix4fv(g->GetUniformLocation(s->ribbon, "to_clip"), 1, GL_FALSE, clip);
        uniform_rgb(g, s->ribbon, "colour", k->rgb, true);
        draw_loose(g, GL_TRIANGLES, points, 6 * pieces);
        for (int v = 0; v < 3 * k->count; v++) joint[v] = (float)k->xyz[v];
        draw_balls(s, &p->view, width, height, joint, k->count, k->width_mm / 2, k->rgb, stroke_lift_mm,
                   true);
        free(points);
        free(joint);
    }
    for (int i = 0; i < p->mark_count; i++) {
        const mark *k = p->marks + i;
        if (k->on_top != on_top) continue;
        float at[3] = {(float)k->xyz[0], (float)k->xyz[1], (float)k->xyz[2]};
        draw_balls(s, &p->view, width, height, at, 1, k->radius_mm, k->rgb, k->radius_mm + stroke_lift_mm,
                   false);
    }
    g->Enable(GL_DEPTH_TEST);
}

/* A mark is seen if nothing lies more than its own lift in front of it. */
static void look_for_marks(const gl *g, const picture *p, const canvas *c, int w, int h, uint8_t *seen)
{
    g->BindFramebuffer(GL_READ_FRAMEBUFFER, c->many);
    g->BindFramebuffer(GL_DRAW_FRAMEBUFFER, c->one);
    g->BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    g->BindFramebuffer(GL_READ_FRAMEBUFFER, c->one);
    for (int i = 0; i < p->mark_count; i++) {
        const double *a = p->marks[i].xyz;
        float clip[16], depth = 1;
        double t[4];
        clip_matrix(&p->view, w, h, p->marks[i].radius_mm + 2 * stroke_lift_mm, clip);
        for (int r = 0; r < 4; r++)
            t[r] = (double)clip[r] * a[0] + (double)clip[4 + r] * a[1] + (double)clip[8 + r] * a[2] +
                   (double)clip[12 + r];
        int x = (int)((t[0] / t[3] + 1) / 2 * w), y = (int)((t[1] / t[3] + 1) / 2 * h);
        bool inside = x >= 0 && y >= 0 && x < w && y < h;
        if (inside) g->ReadPixels(x, y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
        seen[i] = inside && (p->marks[i].on_top || (t[2] / t[3] + 1) / 2 <= (double)depth);
    }
}

static void finish(studio *s, const canvas *c, const picture_style *style, image *out)
{
    const gl *g = &s->gl;
    int w = style->width * style->supersample, h = style->height * style->supersample;
    g->BindFramebuffer(GL_READ_FRAMEBUFFER, c->many);
    g->BindFramebuffer(GL_DRAW_FRAMEBUFFER, c->one);
    g->BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    g->BindFramebuffer(GL_FRAMEBUFFER, c->final);
    g->Viewport(0, 0, style->width, style->height);
    g->Disable(GL_DEPTH_TEST);
    g->UseProgram(s->finish);
    g->Uniform1i(g->GetUniformLocation(s->finish, "factor"), style->supersample);
    uniform_float(g, s->finish, "height", style->height);
    uniform_float(g, s->finish, "exposure", style->exposure);
    uniform_rgb(g, s->finish, "top", style->background_top, false);
    uniform_rgb(g, s->finish, "bottom", style->background_bottom, false);
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
    bool fits = c->width == style->width && c->height == style->height && c->factor == style->supersample;
    if (!fits) {
        if (c->width) canvas_close(&s->gl, c);
        bool ok = canvas_open(&s->gl, style->width, style->height, style->supersample, c, e);
        if (!ok) {
            canvas_close(&s->gl, c);
            return false;
        }
    }
    s->gl.BindFramebuffer(GL_FRAMEBUFFER, c->many);
    return true;
}

bool picture_render(studio *s, const picture *p, const picture_style *style, image *out, uint8_t *mark_seen,
                    err *e)
{
    if (!check(p, style, e) || !studio_use(s, e)) return false;
    const gl *g = &s->gl;
    int w = style->width * style->supersample, h = style->height * style->supersample;
    bool ok = use_canvas(s, style, e);
    canvas c = s->sheet;
    loaded *x = NEW_ARRAY(loaded, p->layer_count);
    image drawn = {0};
    if (ok) {
        for (int i = 0; i < p->layer_count; i++) x[i] = load_layer(g, p->layers + i);
        g->Viewport(0, 0, w, h);
        g->Enable(GL_DEPTH_TEST);
        g->Enable(GL_PROGRAM_POINT_SIZE);
        g->DepthMask(GL_TRUE);
        color_writes(g, true);
        g->ClearColor(0, 0, 0, 0);
        g->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        g->UseProgram(s->shade);
        float clip[16];
        lamps lamp = lamps_of(&p->view);
        double eye[3];
        clip_matrix(&p->view, w, h, 0, clip);
        vec_axpy(p->view.target, p->view.eye_mm, p->view.back, eye);
        g->UniformMatrix4fv(g->GetUniformLocation(s->shade, "to_clip"), 1, GL_FALSE, clip);
        uniform_rgb(g, s->shade, "eye", eye, false);
        uniform_rgb(g, s->shade, "back", p->view.back, false);
        uniform_float(g, s->shade, "perspective", p->view.eye_mm > 0);
        uniform_rgb(g, s->shade, "no_data", colormap_no_data, true);
        g->Uniform3fv(g->GetUniformLocation(s->shade, "key_direction"), 1, lamp.key);
        g->Uniform3fv(g->GetUniformLocation(s->shade, "fill_direction"), 1, lamp.fill);
        g->DepthFunc(GL_LESS);
        g->Disable(GL_BLEND);
        draw_extras(s, p, w, h, false);
        draw_layers(s, p, x, clip);
        if (mark_seen) look_for_marks(g, p, &c, w, h, mark_seen);
        g->BindFramebuffer(GL_FRAMEBUFFER, c.many);
        draw_extras(s, p, w, h, true);
        finish(s, &c, style, &drawn);
        g->BindVertexArray(0);
        for (int i = 0; i < p->layer_count; i++) unload_layer(g, x + i);
        ok = studio_check(s, "drawing", e);
    }
    free(x);
    g->BindFramebuffer(GL_FRAMEBUFFER, 0);
    if (ok)
        *out = drawn;
    else
        image_free(&drawn);
    return ok;
}
