#include "render/src/draw.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

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
            for (int d = 0; d < 3; d++) out[18 * i + 3 * q + d] = (float)((end[q] ? b : a)[d] + sign[q] * side[d]);
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

static void draw_balls(studio *s, const camera *c, int width, int height, const float *xyz, int count, double radius_mm,
                       const double rgb[3], double lift_mm, bool flat)
{
    const gl *g = &s->gl;
    float clip[16];
    clip_matrix(c, width, height, lift_mm, clip);
    g->UseProgram(s->ball);
    g->UniformMatrix4fv(g->GetUniformLocation(s->ball, "to_clip"), 1, GL_FALSE, clip);
    set_float(g, s->ball, "size", 2 * radius_mm * camera_scale(c, height));
    set_float(g, s->ball, "flat_shade", flat);
    set_rgb(g, s->ball, "colour", rgb, true);
    draw_loose(g, GL_POINTS, xyz, count);
}

/* Cut lines lie on the bone: seen this much nearer, they do not sink into it. */
static const double stroke_lift_mm = 0.8;

void draw_extras(studio *s, const picture *p, int width, int height, bool on_top)
{
    const gl *g = &s->gl;
    if (on_top) g->Disable(GL_DEPTH_TEST);
    g->DepthFunc(GL_LESS);
    g->Enable(GL_BLEND);
    g->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (int i = 0; i < p->stroke_count; i++) {
        const stroke *k = p->strokes + i;
        int pieces = k->closed ? k->count : k->count - 1;
        if (k->on_top != on_top || pieces < 1) continue;
        float clip[16], *points = ribbon(k, &p->view, pieces), *joint = NEW_ARRAY(float, 3 * (size_t)k->count);
        clip_matrix(&p->view, width, height, stroke_lift_mm, clip);
        rigid stay = rigid_identity();
        g->UseProgram(s->ribbon);
        set_move(g, s->ribbon, &stay);
        g->UniformMatrix4fv(g->GetUniformLocation(s->ribbon, "to_clip"), 1, GL_FALSE, clip);
        set_rgb(g, s->ribbon, "colour", k->rgb, true);
        draw_loose(g, GL_TRIANGLES, points, 6 * pieces);
        for (int v = 0; v < 3 * k->count; v++) joint[v] = (float)k->xyz[v];
        draw_balls(s, &p->view, width, height, joint, k->count, k->width_mm / 2, k->rgb, stroke_lift_mm, true);
        free(points);
        free(joint);
    }
    for (int i = 0; i < p->mark_count; i++) {
        const mark *k = p->marks + i;
        if (k->on_top != on_top) continue;
        float at[3] = {(float)k->xyz[0], (float)k->xyz[1], (float)k->xyz[2]};
        draw_balls(s, &p->view, width, height, at, 1, k->radius_mm, k->rgb, k->radius_mm + stroke_lift_mm, false);
    }
    g->Disable(GL_BLEND);
    g->Enable(GL_DEPTH_TEST);
}

/* A mark is seen if nothing lies more than its own lift in front of it. */
void look_for_marks(studio *s, const picture *p, int w, int h, uint8_t *seen)
{
    const gl *g = &s->gl;
    const canvas *c = &s->sheet;
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
            t[r] =
                (double)clip[r] * a[0] + (double)clip[4 + r] * a[1] + (double)clip[8 + r] * a[2] + (double)clip[12 + r];
        int x = (int)((t[0] / t[3] + 1) / 2 * w), y = (int)((t[1] / t[3] + 1) / 2 * h);
        bool inside = x >= 0 && y >= 0 && x < w && y < h;
        if (inside) g->ReadPixels(x, y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
        seen[i] = inside && (p->marks[i].on_top || (t[2] / t[3] + 1) / 2 <= (double)depth);
    }
}
