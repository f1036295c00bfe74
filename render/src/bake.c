/* Light transfer: for each of a few dozen directions the layers are drawn into a depth map, and every vertex
 * that the map hides loses the light from there. */
#include "render/picture.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>

enum { MAP_SIDE = 640 };
static const double lift_mm = 0.7; /* sample point above the surface: more than the steps of a CT skin */
static const double bias_mm = 0.6; /* depth slack, about one map cell on a 300 mm head */

void harmonics_at(const double d[3], double y[HARMONICS])
{
    double x = d[0], v = d[1], z = d[2];
    y[0] = 0.28209479177387814;
    y[1] = 0.4886025119029199 * v;
    y[2] = 0.4886025119029199 * z;
    y[3] = 0.4886025119029199 * x;
    y[4] = 1.0925484305920792 * x * v;
    y[5] = 1.0925484305920792 * v * z;
    y[6] = 0.31539156525252005 * (3 * z * z - 1);
    y[7] = 1.0925484305920792 * x * z;
    y[8] = 0.5462742152960396 * (x * x - v * v);
}

void sphere_direction(int i, int n, double d[3])
{
    const double turn = M_PI * (3 - sqrt(5.0));
    double z = 1 - (2 * i + 1.0) / n, r = sqrt(fmax(0, 1 - z * z));
    d[0] = r * cos(turn * i);
    d[1] = r * sin(turn * i);
    d[2] = z;
}

typedef struct job {
    const model *m;
    rigid move;
    double toward[3], right[3], up[3], centre[3], radius; /* of the depth map */
    double toward_local[3];
    double y[HARMONICS], share; /* harmonics of the direction in the model's own axes; 4 / directions */
    const float *depth;         /* [MAP_SIDE^2], 0 nearest to the light */
    float *lost;                /* [HARMONICS*vertex_count] */
} job;

/* Share of the four surrounding map cells that hide the point. */
static double hidden(const job *j, const double p[3])
{
    double d[3];
    vec_sub(p, j->centre, d);
    double u = (vec_dot(d, j->right) / j->radius + 1) / 2 * MAP_SIDE - 0.5;
    double v = (vec_dot(d, j->up) / j->radius + 1) / 2 * MAP_SIDE - 0.5;
    double z = (1 - vec_dot(d, j->toward) / j->radius) / 2 - bias_mm / (2 * j->radius);
    int iu = (int)floor(u), iv = (int)floor(v);
    if (iu < 0 || iv < 0 || iu + 1 >= MAP_SIDE || iv + 1 >= MAP_SIDE) return 0;
    double fu = u - iu, fv = v - iv, sum = 0;
    for (int b = 0; b < 2; b++)
        for (int a = 0; a < 2; a++)
            if ((double)j->depth[(size_t)(iv + b) * MAP_SIDE + (size_t)(iu + a)] < z)
                sum += (a ? fu : 1 - fu) * (b ? fv : 1 - fv);
    return sum;
}

static void gather(int64_t begin, int64_t end, void *context)
{
    const job *j = context;
    for (int64_t v = begin; v < end; v++) {
        const float *n = j->m->normal + 3 * v, *x = j->m->xyz + 3 * v;
        double normal[3] = {(double)n[0], (double)n[1], (double)n[2]},
               facing = vec_dot(normal, j->toward_local);
        if (facing <= 0) continue;
        double p[3] = {(double)x[0], (double)x[1], (double)x[2]};
        vec_axpy(p, lift_mm, normal, p);
        rigid_apply(&j->move, p, p);
        double share = j->share * facing * hidden(j, p);
        if (share > 0)
            for (int i = 0; i < HARMONICS; i++) j->lost[HARMONICS * v + i] += (float)(share * j->y[i]);
    }
}

/* World to clip of an orthographic view of the sphere (column-major). */
static void light_matrix(const job *j, float m[16])
{
    const double *axis[3] = {j->right, j->up, j->toward};
    for (int r = 0; r < 3; r++) {
        double sign = r == 2 ? -1 : 1;
        for (int c = 0; c < 3; c++) m[4 * c + r] = (float)(sign * axis[r][c] / j->radius);
        m[12 + r] = (float)(-sign * vec_dot(axis[r], j->centre) / j->radius);
    }
    m[3] = m[7] = m[11] = 0;
    m[15] = 1;
}

static void move_matrix(const rigid *a, float m[16])
{
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) m[4 * c + r] = (float)a->r[3 * r + c];
        m[12 + c] = (float)a->t[c];
        m[4 * c + 3] = 0;
    }
    m[15] = 1;
}

static void bounding_sphere(const layer *layers, int count, double centre[3], double *radius)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int l = 0; l < count; l++)
        for (int32_t v = 0; v < layers[l].shape->vertex_count; v++) {
            const float *x = layers[l].shape->xyz + 3 * (size_t)v;
            double p[3] = {(double)x[0], (double)x[1], (double)x[2]};
            rigid_apply(&layers[l].move, p, p);
            for (int c = 0; c < 3; c++) {
                low[c] = fmin(low[c], p[c]);
                high[c] = fmax(high[c], p[c]);
            }
        }
    for (int c = 0; c < 3; c++) centre[c] = (low[c] + high[c]) / 2;
    *radius = vec_distance(low, high) / 2 + 2;
}

static void finish_transfer(model *m, const float *lost, float *work)
{
    static const double lobe[HARMONICS] = {1,       2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 4,
                                           1.0 / 4, 1.0 / 4, 1.0 / 4, 1.0 / 4};
    float *transfer = NEW_ARRAY(float, 2 * HARMONICS * (size_t)m->vertex_count);
    /* The open lobe is exact; only what is hidden was sampled, so that open skin carries no sampling noise.
     */
    for (int32_t v = 0; v < m->vertex_count; v++) {
        const float *n = m->normal + 3 * (size_t)v;
        double y[HARMONICS];
        harmonics_at((double[3]){(double)n[0], (double)n[1], (double)n[2]}, y);
        for (size_t i = 0; i < HARMONICS; i++)
            work[HARMONICS * (size_t)v + i] = (float)(lobe[i] * y[i]) - lost[HARMONICS * (size_t)v + i];
    }
    for (int part = 0; part < 2; part++) {
        model_smooth(m, work, HARMONICS, part ? m->scatter_passes : 1);
        for (int32_t v = 0; v < m->vertex_count; v++)
            for (size_t i = 0; i < HARMONICS; i++)
                transfer[(2 * (size_t)v + (size_t)part) * HARMONICS + i] = work[HARMONICS * (size_t)v + i];
    }
    model_set_transfer(m, transfer);
    free(transfer);
}

bool picture_bake(studio *s, const layer *layers, int layer_count, int directions, err *e)
{
    if (layer_count < 1) return true;
    if (directions < 32 || directions > 1024)
        return err_set(e, ERR_USAGE, "light from %d directions: 32 to 1024 are possible", directions);
    if (!studio_use(s, e)) return false;
    const gl *g = &s->gl;
    GLuint frame, depth_buffer;
    g->GenFramebuffers(1, &frame);
    g->BindFramebuffer(GL_FRAMEBUFFER, frame);
    g->GenRenderbuffers(1, &depth_buffer);
    g->BindRenderbuffer(GL_RENDERBUFFER, depth_buffer);
    g->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, MAP_SIDE, MAP_SIDE);
    g->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_buffer);
    g->DrawBuffer(GL_NONE);
    g->ReadBuffer(GL_NONE);
    bool ok = g->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ||
              err_set(e, ERR_RESOURCE, "no picture: the depth map for the light cannot be made");

    float *depth = NEW_ARRAY(float, MAP_SIDE *MAP_SIDE), **lost = NEW_ARRAY(float *, layer_count);
    for (int l = 0; l < layer_count; l++)
        lost[l] = NEW_ARRAY(float, HARMONICS *(size_t)layers[l].shape->vertex_count);
    job j = {.share = 4.0 / directions, .depth = depth};
    bounding_sphere(layers, layer_count, j.centre, &j.radius);
    g->Viewport(0, 0, MAP_SIDE, MAP_SIDE);
    g->Enable(GL_DEPTH_TEST);
    g->Disable(GL_BLEND);
    /* Sides that face away hide nothing that the sides facing the light do not; closed or not, half the work.
     */
    g->Enable(GL_CULL_FACE);
    g->CullFace(GL_BACK);
    g->DepthFunc(GL_LESS);
    g->DepthMask(GL_TRUE);
    g->UseProgram(s->ribbon);
    GLint to_clip = g->GetUniformLocation(s->ribbon, "to_clip"),
          moving = g->GetUniformLocation(s->ribbon, "move");
    for (int i = 0; ok && i < directions; i++) {
        sphere_direction(i, directions, j.toward);
        double helper[3] = {fabs(j.toward[0]) < 0.7, fabs(j.toward[0]) >= 0.7, 0};
        vec_cross(helper, j.toward, j.right);
        vec_normalize(j.right);
        vec_cross(j.toward, j.right, j.up);
        float light[16], move[16];
        light_matrix(&j, light);
        g->UniformMatrix4fv(to_clip, 1, GL_FALSE, light);
        g->Clear(GL_DEPTH_BUFFER_BIT);
        for (int l = 0; l < layer_count; l++) {
            move_matrix(&layers[l].move, move);
            g->UniformMatrix4fv(moving, 1, GL_FALSE, move);
            g->BindVertexArray(layers[l].shape->array);
            g->DrawElements(GL_TRIANGLES, 3 * layers[l].shape->triangle_count, GL_UNSIGNED_INT, NULL);
        }
        g->ReadPixels(0, 0, MAP_SIDE, MAP_SIDE, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
        for (int l = 0; l < layer_count; l++) {
            rigid back = rigid_inverse(&layers[l].move);
            j.m = layers[l].shape;
            j.move = layers[l].move;
            j.lost = lost[l];
            rigid_rotate(&back, j.toward, j.toward_local);
            harmonics_at(j.toward_local, j.y);
            parallel_for(j.m->vertex_count, 8192, gather, &j);
        }
        ok = studio_check(s, "gathering the light", e);
    }
    for (int l = 0; l < layer_count; l++) {
        float *work = NEW_ARRAY(float, HARMONICS *(size_t)layers[l].shape->vertex_count);
        if (ok) finish_transfer(layers[l].shape, lost[l], work);
        free(work);
        free(lost[l]);
    }
    free(lost);
    free(depth);
    g->Disable(GL_CULL_FACE);
    g->BindVertexArray(0);
    g->BindFramebuffer(GL_FRAMEBUFFER, 0);
    g->DeleteFramebuffers(1, &frame);
    g->DeleteRenderbuffers(1, &depth_buffer);
    return ok;
}
