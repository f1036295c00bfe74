#include "app/pictures/patchwork.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <math.h>

const double patchwork_red[3] = {0.84, 0.07, 0.10}, patchwork_blue[3] = {0.10, 0.32, 0.88};
static const double pale[3] = {0.74, 0.84, 0.97}, parted_mm = 0.5, dark_blue_mm = 5;
static const double coarse_mm = 2, fine_mm = 0.4; /* triangles that are painted: of one kind, at its border */

static void add_triangle(patchwork *w, double x[3][3], const rigid *move, const double rgb[3])
{
    if (w->s.triangle_count == w->room) {
        w->room = 2 * w->room + 64;
        w->s.xyz = GROW_ARRAY(double, w->s.xyz, 9 * (size_t)w->room);
        w->s.tri = GROW_ARRAY(int32_t, w->s.tri, 3 * (size_t)w->room);
        w->s.rgb = GROW_ARRAY(uint8_t, w->s.rgb, 9 * (size_t)w->room);
    }
    for (int k = 0; k < 3; k++) {
        size_t v = (size_t)w->s.vertex_count++;
        rigid_apply(move, x[k], w->s.xyz + 3 * v);
        w->s.tri[v] = (int32_t)v;
        for (int c = 0; c < 3; c++) w->s.rgb[3 * v + (size_t)c] = (uint8_t)lround(255 * rgb[c]);
    }
    w->s.triangle_count++;
}

typedef struct brush { /* what is painted of the triangles of one bone that is moved against another */
    patchwork *to;
    const clash_body *other;
    const nearest *sight; /* of gaps: to look for the other bone */
    rigid rel, move;
    double saw_mm; /* of gaps */
} brush;

static double longest_edge(double x[3][3])
{
    return fmax(vec_distance(x[0], x[1]), fmax(vec_distance(x[1], x[2]), vec_distance(x[2], x[0])));
}

/* Calls paint for each of four parts. */
static void quarter(const brush *b, double x[3][3], void (*paint)(const brush *, double[3][3]))
{
    double m[3][3], y[3][3];
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) m[k][c] = (x[k][c] + x[(k + 1) % 3][c]) / 2;
    paint(b, m);
    for (int k = 0; k < 3; k++) {
        vec_copy(x[k], y[0]);
        vec_copy(m[k], y[1]);
        vec_copy(m[(k + 2) % 3], y[2]);
        paint(b, y);
    }
}

/* The part of a triangle that lies within the other bone. */
static void paint_overlap(const brush *b, double x[3][3])
{
    const solid_grid *grid = clash_body_grid(b->other);
    double middle[3] = {0}, p[3], edge = longest_edge(x);
    int in = 0;
    for (int k = 0; k < 3; k++) {
        vec_axpy(middle, 1 / 3.0, x[k], middle);
        rigid_apply(&b->rel, x[k], p);
        in += solid_grid_inside(grid, p);
    }
    rigid_apply(&b->rel, middle, p);
    if (!in && solid_grid_clear(grid, p) > edge) return;
    if (edge > ((in == 0 || in == 3) ? coarse_mm : fine_mm))
        quarter(b, x, paint_overlap);
    else if (in >= 2)
        add_triangle(b->to, x, &b->move, patchwork_red);
}

/* The part of a cut's face that has no bone opposite within the saw's width and a little. */
static void paint_gap(const brush *b, double x[3][3])
{
    double middle[3] = {0}, p[3], e1[3], e2[3], n[3], hit[3], rgb[3];
    if (longest_edge(x) > coarse_mm) {
        quarter(b, x, paint_gap);
        return;
    }
    for (int k = 0; k < 3; k++) vec_axpy(middle, 1 / 3.0, x[k], middle);
    vec_sub(x[1], x[0], e1);
    vec_sub(x[2], x[0], e2);
    vec_cross(e1, e2, n);
    rigid_apply(&b->rel, middle, p);
    rigid_rotate(&b->rel, n, n);
    if (solid_grid_inside(clash_body_grid(b->other), p)) return;
    bool faces = nearest_ray(b->sight, p, n, hit, NULL);
    double gap = (faces ? vec_distance(p, hit) : 2 * dark_blue_mm) - b->saw_mm, share = fmin(gap / dark_blue_mm, 1);
    if (gap < parted_mm) return;
    for (int c = 0; c < 3; c++) rgb[c] = pale[c] + share * (patchwork_blue[c] - pale[c]);
    add_triangle(b->to, x, &b->move, rgb);
    double back[3][3]; /* to be seen from behind too */
    vec_sub(x[1], x[0], e1);
    vec_sub(x[2], x[0], e2);
    vec_cross(e1, e2, n);
    vec_normalize(n);
    for (int k = 0; k < 3; k++) vec_axpy(x[2 - k], -0.05, n, back[k]);
    add_triangle(b->to, back, &b->move, rgb);
}

static void paint(const surface *s, const brush *b, void (*with)(const brush *, double[3][3]))
{
    for (int32_t t = 0; t < s->triangle_count; t++) {
        double x[3][3];
        for (int k = 0; k < 3; k++) vec_copy(s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k], x[k]);
        with(b, x);
    }
}

void patchwork_overlap(patchwork *to, const surface *bone, const clash_body *other, const rigid *rel, const rigid *move)
{
    brush b = {.to = to, .other = other, .rel = *rel, .move = *move};
    paint(bone, &b, paint_overlap);
}

bool patchwork_gap(patchwork *to, const surface *face, const clash_body *other, const surface *bone, const rigid *rel,
                   const rigid *move, double saw_mm, err *e)
{
    nearest *sight;
    if (!nearest_create(bone, &sight, e)) return false;
    brush b = {.to = to, .other = other, .sight = sight, .rel = *rel, .move = *move, .saw_mm = saw_mm};
    paint(face, &b, paint_gap);
    nearest_destroy(&sight);
    return true;
}
