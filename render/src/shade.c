#include "render/src/shade.h"
#include "render/src/light.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>

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
static const float outline_rgb[3] = {0.85f, 0.93f, 1.0f};
static const float map_shine = 0.3f; /* colours that carry a number are to be read: less highlight over them */

void material_color(material m, double rgb[3]) { vec_copy(looks[m].rgb, rgb); }

typedef struct job {
    const layer *l;
    const model *m;
    const look *k;
    float light[3 * HARMONICS], key[3], fill[3], back[3], eye[3]; /* all in the model's own axes */
    bool perspective;
    shading out;
} job;

static float dot3(const float *a, const float *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void unit3(float *a)
{
    float n = sqrtf(dot3(a, a));
    if (n > 0)
        for (int c = 0; c < 3; c++) a[c] /= n;
}

/* Blinn and Phong's highlight, normalised, with Schlick's Fresnel term. */
static float glint(const float *n, const float *v, const float *l, float gloss)
{
    float h[3] = {l[0] + v[0], l[1] + v[1], l[2] + v[2]}, facing = dot3(n, l);
    unit3(h);
    float nh = dot3(n, h), miss = 1 - fmaxf(dot3(v, h), 0);
    if (facing <= 0 || nh <= 0) return 0;
    float fresnel = 0.04f + 0.96f * miss * miss * miss * miss * miss;
    return powf(nh, gloss) * (gloss + 8) * 0.0398f * fresnel * facing;
}

static void shade_vertices(int64_t begin, int64_t end, void *context)
{
    const job *j = context;
    const look *k = j->k;
    float shine = j->l->scalar ? map_shine * k->shine : k->shine, opacity = (float)j->l->opacity;
    for (int64_t i = begin; i < end; i++) {
        const float *n = j->m->normal + 3 * i, *sharp = j->m->sharp + HARMONICS * i, *soft = j->m->soft + HARMONICS * i;
        float v[3] = {j->back[0], j->back[1], j->back[2]}, *light = j->out.light + 4 * i, *spark = j->out.spark + 4 * i;
        if (j->perspective) {
            for (int c = 0; c < 3; c++) v[c] = j->eye[c] - j->m->xyz[3 * i + c];
            unit3(v);
        }
        for (int c = 0; c < 3; c++) {
            float hard = 0, spread = 0;
            for (int h = 0; h < HARMONICS; h++) {
                hard += j->light[3 * h + c] * sharp[h];
                spread += j->light[3 * h + c] * soft[h];
            }
            light[c] = fmaxf(0, hard + k->scatter[c] * (spread - hard));
        }
        /* the transfer of degree 0 is Y_00 where nothing hides the sky */
        float sky = fminf(1, fmaxf(0, sharp[0] / 0.28209479f)), nv = dot3(n, v), edge = 1 - fminf(1, fmaxf(0, nv));
        float bright = shine * (glint(n, v, j->key, k->gloss) + 0.35f * glint(n, v, j->fill, k->gloss));
        light[3] = 1 - sky;
        for (int c = 0; c < 3; c++)
            spark[c] = sky * sky * (bright + k->sheen * edge * edge * edge * edge * outline_rgb[c]);
        /* clearer where it faces the viewer, denser towards its outline */
        float side = 1 - fminf(1, fabsf(nv)), dense = j->l->over ? side * side * side : side * side;
        spark[3] = opacity < 1 ? opacity + (1 - opacity) * 0.9f * dense : 1;
        if (opacity < 1 && j->l->weight) spark[3] *= (float)j->l->weight[j->m->source[i]];
    }
}

static void to_local(const rigid *back, const double d[3], bool point, float out[3])
{
    double local[3];
    if (point)
        rigid_apply(back, d, local);
    else
        rigid_rotate(back, d, local);
    for (int c = 0; c < 3; c++) out[c] = (float)local[c];
}

shading shade(const layer *l, const camera *c)
{
    size_t n = (size_t)l->shape->vertex_count;
    job j = {.l = l,
             .m = l->shape,
             .k = looks + l->kind,
             .perspective = c->eye_mm > 0,
             .out = {NEW_ARRAY(float, 4 * n), NEW_ARRAY(float, 4 * n)}};
    rigid back = rigid_inverse(&l->move);
    lamps lamp = lamps_of(c);
    double eye[3];
    vec_axpy(c->target, c->eye_mm, c->back, eye);
    lamps_project(c, &l->move, j.light);
    to_local(&back, lamp.key, false, j.key);
    to_local(&back, lamp.fill, false, j.fill);
    to_local(&back, c->back, false, j.back);
    to_local(&back, eye, true, j.eye);
    parallel_for(l->shape->vertex_count, 8192, shade_vertices, &j);
    return j.out;
}

void shading_free(shading *s)
{
    free(s->light);
    free(s->spark);
    *s = (shading){0};
}
