#include "render/src/draw.h"
#include "render/src/shade.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

typedef struct loaded { /* what a layer needs besides its model, for one picture; 0: not there */
    GLuint light, spark, colour, value, map;
} loaded;

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

static GLuint load_colours(const gl *g, const layer *l)
{
    const model *m = l->shape;
    float linear[256], *rgb = NEW_ARRAY(float, 3 * (size_t)m->vertex_count);
    for (int i = 0; i < 256; i++) linear[i] = (float)colormap_linear(i / 255.0);
    for (size_t v = 0; v < (size_t)m->vertex_count; v++)
        for (size_t k = 0; k < 3; k++) rgb[3 * v + k] = linear[l->vertex_rgb[3 * (size_t)m->source[v] + k]];
    GLuint buffer = load_floats(g, rgb, 3 * (size_t)m->vertex_count);
    free(rgb);
    return buffer;
}

static GLuint load_values(const gl *g, const layer *l)
{
    const model *m = l->shape;
    float *value = NEW_ARRAY(float, 2 * (size_t)m->vertex_count);
    for (size_t v = 0; v < (size_t)m->vertex_count; v++) {
        double x = l->scalar[m->source[v]];
        bool known = !isnan(x);
        value[2 * v] = known ? (float)((x - l->low) / (l->high - l->low)) : 0;
        value[2 * v + 1] = known;
    }
    GLuint buffer = load_floats(g, value, 2 * (size_t)m->vertex_count);
    free(value);
    return buffer;
}

static loaded load_layer(const gl *g, const layer *l, const camera *c)
{
    loaded out = {0};
    shading lit = shade(l, c);
    size_t n = 4 * (size_t)l->shape->vertex_count;
    out.light = load_floats(g, lit.light, n);
    out.spark = load_floats(g, lit.spark, n);
    shading_free(&lit);
    if (l->vertex_rgb && !l->scalar) out.colour = load_colours(g, l);
    if (l->scalar) {
        out.value = load_values(g, l);
        out.map = load_map(g, l->map);
    }
    return out;
}

static void unload_layer(const gl *g, loaded *x)
{
    g->DeleteBuffers(4, (GLuint[4]){x->light, x->spark, x->colour, x->value});
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

/* The inside of a closed surface is never seen: leaving it out saves half of the triangles. */
static void draw_triangles(const gl *g, const model *m)
{
    if (m->closed) g->Enable(GL_CULL_FACE);
    g->BindVertexArray(m->array);
    g->DrawElements(GL_TRIANGLES, 3 * m->triangle_count, GL_UNSIGNED_INT, NULL);
    g->Disable(GL_CULL_FACE);
}

static void draw_depth(studio *s, const layer *l)
{
    s->gl.UseProgram(s->ribbon);
    set_move(&s->gl, s->ribbon, &l->move);
    draw_triangles(&s->gl, l->shape);
}

static void draw_layer(studio *s, const layer *l, const camera *c)
{
    const gl *g = &s->gl;
    loaded x = load_layer(g, l, c);
    GLuint program = l->scalar ? s->map : s->shade;
    g->UseProgram(program);
    set_move(g, program, &l->move);
    if (l->scalar) set_float(g, program, "fade", (l->fade_end - l->low) / (l->high - l->low));
    g->BindTexture(GL_TEXTURE_2D, x.map);
    g->BindVertexArray(l->shape->array);
    set_attribute(g, 1, 4, x.light, 0, 0, 0);
    set_attribute(g, 2, 4, x.spark, 0, 0, 0);
    set_attribute(g, 3, 3, x.colour, colormap_linear(l->rgb[0]), colormap_linear(l->rgb[1]),
                  colormap_linear(l->rgb[2]));
    set_attribute(g, 4, 2, x.value, 0, 1, 0);
    draw_triangles(g, l->shape);
    unload_layer(g, &x);
}

static void color_writes(const gl *g, bool on) { g->ColorMask(on, on, on, on); }

static void set_camera(studio *s, const picture *p, int width, int height)
{
    const gl *g = &s->gl;
    float clip[16];
    clip_matrix(&p->view, width, height, 0, clip);
    const GLuint programs[] = {s->ribbon, s->shade, s->map};
    for (int i = 0; i < 3; i++) {
        g->UseProgram(programs[i]);
        g->UniformMatrix4fv(g->GetUniformLocation(programs[i], "to_clip"), 1, GL_FALSE, clip);
    }
    set_rgb(g, s->map, "no_data", colormap_no_data, true);
}

void draw_opaque_layers(studio *s, const picture *p, int width, int height)
{
    set_camera(s, p, width, height);
    s->gl.Disable(GL_BLEND);
    s->gl.DepthFunc(GL_LESS);
    for (int i = 0; i < p->layer_count; i++)
        if (p->layers[i].opacity >= 1) draw_layer(s, p->layers + i, &p->view);
}

void draw_clear_layers(studio *s, const picture *p, int width, int height)
{
    const gl *g = &s->gl;
    bool first = true;
    set_camera(s, p, width, height);
    for (int i = 0; i < p->layer_count; i++) {
        const layer *l = p->layers + i;
        if (l->opacity >= 1) continue;
        color_writes(g, false);
        if (!first || l->over) g->Clear(GL_DEPTH_BUFFER_BIT); /* forget the depth of the clear layer before */
        for (int k = 0; !first && !l->over && k < p->layer_count; k++)
            if (p->layers[k].opacity >= 1) draw_depth(s, p->layers + k);
        first = false;
        draw_depth(s, l);
        color_writes(g, true);
        g->Enable(GL_BLEND);
        g->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        g->DepthFunc(GL_EQUAL);
        draw_layer(s, l, &p->view);
        g->Disable(GL_BLEND);
        g->DepthFunc(GL_LESS);
    }
}
