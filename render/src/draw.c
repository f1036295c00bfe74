#include "render/src/draw.h"
#include "render/colormap.h"
#include "geometry/vec.h"

void clip_matrix(const camera *c, int width, int height, double toward_mm, float m[16])
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

void set_rgb(const gl *g, GLuint program, const char *name, const double srgb[3], bool to_linear)
{
    float c[3];
    for (int k = 0; k < 3; k++) c[k] = (float)(to_linear ? colormap_linear(srgb[k]) : srgb[k]);
    g->Uniform3fv(g->GetUniformLocation(program, name), 1, c);
}

void set_float(const gl *g, GLuint program, const char *name, double x)
{
    g->Uniform1f(g->GetUniformLocation(program, name), (float)x);
}

GLuint load_floats(const gl *g, const float *values, size_t count)
{
    GLuint buffer;
    g->GenBuffers(1, &buffer);
    g->BindBuffer(GL_ARRAY_BUFFER, buffer);
    g->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *values), values, GL_STREAM_DRAW);
    return buffer;
}

void set_move(const gl *g, GLuint program, const rigid *a)
{
    float move[16] = {0};
    for (int col = 0; col < 3; col++) {
        for (int r = 0; r < 3; r++) move[4 * col + r] = (float)a->r[3 * r + col];
        move[12 + col] = (float)a->t[col];
    }
    move[15] = 1;
    g->UniformMatrix4fv(g->GetUniformLocation(program, "move"), 1, GL_FALSE, move);
}
