/* grid_cubes: what a solid_grid is made of, for the files that make it and ask it. */
#pragma once
#include "geometry/solid_grid.h"
#include "geometry/vec.h"

typedef struct cube {
    uint8_t away : 7;   /* cubes to the nearest one with triangles, in the maximum norm, at most FAR */
    uint8_t inside : 1; /* of the cube's own point */
} cube;

enum { FAR = 127 };

typedef struct grid_triangle {
    double a[3], e1[3], e2[3];
} grid_triangle;

struct solid_grid {
    const surface *s; /* borrowed while it is made */
    double low[3], step;
    int32_t n[3]; /* multiples of 4 */
    size_t bricks[2];
    cube *cube;
    int32_t *start; /* [cubes + 1] into item */
    int32_t *item;  /* triangles that may meet the cube */
    grid_triangle *triangle;
};

/* Of the cube's own point, in cubes: off any plane that a surface may have. */
static const double own_point[3] = {0.5137, 0.4789, 0.5227};

/* Where a cube is while the grid is made: in rows. */
static inline size_t cell(const solid_grid *g, const int32_t i[3])
{
    return ((size_t)i[2] * (size_t)g->n[1] + (size_t)i[1]) * (size_t)g->n[0] + (size_t)i[0];
}

/* Where it is in the end: 4 x 4 x 4 of them side by side, because those who ask ask about near points. */
static inline size_t place(const solid_grid *g, const int32_t i[3])
{
    const uint32_t x = (uint32_t)i[0], y = (uint32_t)i[1], z = (uint32_t)i[2];
    size_t brick = ((size_t)(z / 4) * g->bricks[1] + y / 4) * g->bricks[0] + x / 4;
    return 64 * brick + 16 * (z % 4) + 4 * (y % 4) + x % 4;
}

static inline void locate(const solid_grid *g, const double p[3], int32_t i[3])
{
    for (int c = 0; c < 3; c++) i[c] = (int32_t)floor((p[c] - g->low[c]) / g->step);
}

static inline bool within(const solid_grid *g, const int32_t i[3])
{
    for (int c = 0; c < 3; c++)
        if (i[c] < 0 || i[c] >= g->n[c]) return false;
    return true;
}

/* Where the straight way from p by `way` crosses the triangle, as a share of it; false if it does not. */
static inline bool crosses(const grid_triangle *t, const double p[3], const double way[3], double *share)
{
    double h[3], o[3], q[3];
    vec_cross(way, t->e2, h);
    double det = vec_dot(t->e1, h);
    if (det == 0) return false;
    vec_sub(p, t->a, o);
    double u = vec_dot(o, h) / det;
    if (!(u >= 0 && u <= 1)) return false;
    vec_cross(o, t->e1, q);
    double w = vec_dot(way, q) / det;
    if (!(w >= 0 && u + w <= 1)) return false;
    *share = vec_dot(t->e2, q) / det;
    return *share >= 0 && *share < 1;
}

static inline int crossings(const solid_grid *g, size_t c, const double p[3], const double way[3], double from,
                            double to)
{
    int count = 0;
    double share;
    for (int32_t k = g->start[c]; k < g->start[c + 1]; k++)
        count += crosses(&g->triangle[g->item[k]], p, way, &share) && share >= from && share < to;
    return count;
}

static inline void own_of(const solid_grid *g, const int32_t i[3], double p[3])
{
    for (int c = 0; c < 3; c++) p[c] = g->low[c] + g->step * (i[c] + own_point[c]);
}
