/* Light transfer: for each of a few dozen directions the layers' triangles go into a depth map, and every
 * vertex that the map hides loses the light from there. The maps are made here and not by OpenGL: setting up
 * a triangle costs a software driver ten times what drawing it into a map costs, on one thread; here
 * directions run in parallel. */
#include "render/picture.h"
#include "render/src/studio.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>

enum { MAP_SIDE = 512 };
static const float lift_mm = 0.7f; /* sample point above the surface: more than the steps of a CT skin */
static const float bias_mm = 0.6f; /* depth slack, about one map cell on a 300 mm head */

typedef struct bake {
    const layer *layers;
    int layer_count, directions;
    double centre[3], radius; /* of a sphere around all layers */
    uint8_t **hidden;         /* per layer [directions*vertex_count]: share of the light that is hidden, of 255 */
} bake;

typedef struct light_map { /* depth of the first surface that light from one direction meets */
    double right[3], up[3], toward[3];
    float *near; /* [MAP_SIDE^2] mm towards the light; -HUGE_VALF: nothing */
} light_map;

/* From a layer's own axes to column and row (in cells) and height towards the light. */
typedef struct placing {
    float row[3][4];
} placing;

static placing place_layer(const bake *b, const light_map *m, const rigid *move)
{
    const double *axis[3] = {m->right, m->up, m->toward};
    rigid back = rigid_inverse(move);
    double from[3];
    vec_sub(move->t, b->centre, from);
    placing out;
    for (int r = 0; r < 3; r++) {
        double local[3], scale = r < 2 ? MAP_SIDE / (2 * b->radius) : 1, shift = r < 2 ? MAP_SIDE / 2.0 - 0.5 : 0;
        rigid_rotate(&back, axis[r], local);
        for (int c = 0; c < 3; c++) out.row[r][c] = (float)(scale * local[c]);
        out.row[r][3] = (float)(scale * vec_dot(axis[r], from) + shift);
    }
    return out;
}

static void place(const placing *k, const float *p, float out[3])
{
    for (int r = 0; r < 3; r++) out[r] = k->row[r][0] * p[0] + k->row[r][1] * p[1] + k->row[r][2] * p[2] + k->row[r][3];
}

static float least(float a, float b, float c)
{
    float ab = a < b ? a : b;
    return ab < c ? ab : c;
}

/* Cells whose middle lies in the triangle. Sides that face away hide nothing that the sides facing the light
 * do not. The result is the largest height of all triangles: their order does not matter. */
static void draw_triangle(float *near, const float *a, const float *b, const float *c)
{
    float abx = b[0] - a[0], aby = b[1] - a[1], acx = c[0] - a[0], acy = c[1] - a[1], area = abx * acy - aby * acx;
    if (!(area > 0)) return;
    float left = least(a[0], b[0], c[0]), low = least(a[1], b[1], c[1]);
    int x0 = (int)left, y0 = (int)low;
    x0 += (float)x0 < left;
    y0 += (float)y0 < low;
    int x1 = (int)-least(-a[0], -b[0], -c[0]), y1 = (int)-least(-a[1], -b[1], -c[1]);
    float per_area = 1 / area, bz = (b[2] - a[2]) * per_area, cz = (c[2] - a[2]) * per_area;
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++) {
            float px = (float)x - a[0], py = (float)y - a[1];
            float v = px * acy - py * acx, w = abx * py - aby * px;
            if (v < 0 || w < 0 || v + w > area) continue;
            float z = a[2] + v * bz + w * cz, *cell = near + y * MAP_SIDE + x;
            if (z > *cell) *cell = z;
        }
}

static void draw_layer(const bake *b, const light_map *m, const layer *l)
{
    const model *s = l->shape;
    placing k = place_layer(b, m, &l->move);
    float *at = NEW_ARRAY(float, 3 * (size_t)s->vertex_count);
    for (size_t v = 0; v < (size_t)s->vertex_count; v++) place(&k, s->xyz + 3 * v, at + 3 * v);
    for (size_t t = 0; t < (size_t)s->triangle_count; t++)
        draw_triangle(m->near, at + 3 * (size_t)s->tri[3 * t], at + 3 * (size_t)s->tri[3 * t + 1],
                      at + 3 * (size_t)s->tri[3 * t + 2]);
    free(at);
}

/* Share of the four surrounding map cells that hide the point. */
static float hidden_at(const float *near, const float at[3])
{
    int x = (int)at[0], y = (int)at[1];
    const float *cell = near + y * MAP_SIDE + x;
    float u = at[0] - (float)x, v = at[1] - (float)y, z = at[2] + bias_mm;
    return (1 - v) * ((cell[0] > z ? 1 - u : 0) + (cell[1] > z ? u : 0)) +
           v * ((cell[MAP_SIDE] > z ? 1 - u : 0) + (cell[MAP_SIDE + 1] > z ? u : 0));
}

static void look_from(const bake *b, const light_map *m, const layer *l, uint8_t *hidden)
{
    const model *s = l->shape;
    placing k = place_layer(b, m, &l->move);
    const float *toward = k.row[2];
    for (size_t v = 0; v < (size_t)s->vertex_count; v++) {
        const float *n = s->normal + 3 * v, *x = s->xyz + 3 * v;
        if (n[0] * toward[0] + n[1] * toward[1] + n[2] * toward[2] <= 0) continue;
        float p[3] = {x[0] + lift_mm * n[0], x[1] + lift_mm * n[1], x[2] + lift_mm * n[2]}, at[3];
        place(&k, p, at);
        hidden[v] = (uint8_t)(255 * hidden_at(m->near, at) + 0.5f);
    }
}

static void bake_direction(int64_t begin, int64_t end, void *context)
{
    const bake *b = context;
    float *near = NEW_ARRAY(float, MAP_SIDE *MAP_SIDE);
    for (int64_t i = begin; i < end; i++) {
        light_map m = {.near = near};
        sphere_direction((int)i, b->directions, m.toward);
        double helper[3] = {fabs(m.toward[0]) < 0.7, fabs(m.toward[0]) >= 0.7, 0};
        vec_cross(helper, m.toward, m.right);
        vec_normalize(m.right);
        vec_cross(m.toward, m.right, m.up);
        for (int c = 0; c < MAP_SIDE * MAP_SIDE; c++) near[c] = -HUGE_VALF;
        for (int l = 0; l < b->layer_count; l++) draw_layer(b, &m, &b->layers[l]);
        for (int l = 0; l < b->layer_count; l++)
            look_from(b, &m, &b->layers[l], b->hidden[l] + i * b->layers[l].shape->vertex_count);
    }
    free(near);
}

typedef struct gathering { /* the light that one layer loses, over all directions */
    const model *shape;
    const uint8_t *hidden;
    int directions;
    const float *way, *harmonics; /* [3*directions], [HARMONICS*directions] in the model's own axes */
    float *transfer;              /* [HARMONICS*vertex_count] */
} gathering;

/* The open lobe is exact; only what is hidden was sampled, so that open skin carries no sampling noise. */
static void gather(int64_t begin, int64_t end, void *context)
{
    const gathering *g = context;
    for (int64_t v = begin; v < end; v++) {
        const float *n = g->shape->normal + 3 * v;
        float *t = g->transfer + HARMONICS * v, lost[HARMONICS] = {0};
        for (int i = 0; i < g->directions; i++) {
            uint8_t hidden = g->hidden[(size_t)i * (size_t)g->shape->vertex_count + (size_t)v];
            if (!hidden) continue;
            const float *d = g->way + 3 * i, *y = g->harmonics + HARMONICS * i;
            float share = (float)hidden * (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
            for (int h = 0; h < HARMONICS; h++) lost[h] += share * y[h];
        }
        lobe_at(n, t);
        for (int h = 0; h < HARMONICS; h++) t[h] -= lost[h] * 4 / (255.0f * (float)g->directions);
    }
}

static void finish_layer(const bake *b, int index)
{
    const layer *l = &b->layers[index];
    model *m = l->shape;
    size_t n = (size_t)m->vertex_count;
    float *way = NEW_ARRAY(float, 3 * b->directions), *y = NEW_ARRAY(float, HARMONICS * b->directions);
    rigid back = rigid_inverse(&l->move);
    for (int i = 0; i < b->directions; i++) {
        double d[3], harmonics[HARMONICS];
        sphere_direction(i, b->directions, d);
        rigid_rotate(&back, d, d);
        harmonics_at(d, harmonics);
        for (int k = 0; k < 3; k++) way[3 * i + k] = (float)d[k];
        for (int h = 0; h < HARMONICS; h++) y[HARMONICS * i + h] = (float)harmonics[h];
    }
    gathering g = {m, b->hidden[index], b->directions, way, y, m->sharp};
    parallel_for(m->vertex_count, 8192, gather, &g);
    model_smooth(m, m->sharp, HARMONICS, 1);
    for (size_t i = 0; i < HARMONICS * n; i++) m->soft[i] = m->sharp[i];
    model_smooth(m, m->soft, HARMONICS, m->scatter_passes);
    free(way);
    free(y);
}

static void bounding_sphere(bake *b)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int l = 0; l < b->layer_count; l++)
        for (size_t v = 0; v < (size_t)b->layers[l].shape->vertex_count; v++) {
            const float *x = b->layers[l].shape->xyz + 3 * v;
            double p[3] = {(double)x[0], (double)x[1], (double)x[2]};
            rigid_apply(&b->layers[l].move, p, p);
            for (int c = 0; c < 3; c++) {
                low[c] = fmin(low[c], p[c]);
                high[c] = fmax(high[c], p[c]);
            }
        }
    for (int c = 0; c < 3; c++) b->centre[c] = (low[c] + high[c]) / 2;
    b->radius = 1.01 * vec_distance(low, high) / 2 + 2; /* all points and their lift fall inside the map */
}

bool picture_bake(const layer *layers, int layer_count, int directions, err *e)
{
    if (layer_count < 1) return true;
    if (directions < 32 || directions > 1024)
        return err_set(e, ERR_USAGE, "light from %d directions: 32 to 1024 are possible", directions);
    bake b = {.layers = layers, .layer_count = layer_count, .directions = directions};
    b.hidden = NEW_ARRAY(uint8_t *, layer_count);
    bounding_sphere(&b);
    for (int l = 0; l < layer_count; l++)
        b.hidden[l] = NEW_ARRAY(uint8_t, (size_t)directions * (size_t)layers[l].shape->vertex_count);
    parallel_for(directions, 1, bake_direction, &b);
    for (int l = 0; l < layer_count; l++) {
        finish_layer(&b, l);
        free(b.hidden[l]);
    }
    free(b.hidden);
    return true;
}
