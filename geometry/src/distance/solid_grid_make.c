/* Making a solid_grid: triangles into cubes, distances between cubes, insides along rows. */
#include "geometry/mem.h"
#include "geometry/src/distance/grid_cubes.h"
#include <stdlib.h>
#include <string.h>

static grid_triangle triangle_of(const surface *s, int32_t t)
{
    const int32_t *v = s->tri + 3 * (size_t)t;
    grid_triangle x;
    vec_copy(s->xyz + 3 * (size_t)v[0], x.a);
    vec_sub(s->xyz + 3 * (size_t)v[1], x.a, x.e1);
    vec_sub(s->xyz + 3 * (size_t)v[2], x.a, x.e2);
    return x;
}

/* The cubes that meet the triangle's box; false if none of the grid's does. */
static bool reach(const solid_grid *g, int32_t t, int32_t from[3], int32_t to[3])
{
    double low[3], high[3];
    for (int c = 0; c < 3; c++) {
        low[c] = HUGE_VAL;
        high[c] = -HUGE_VAL;
        for (int k = 0; k < 3; k++) {
            double x = g->s->xyz[3 * (size_t)g->s->tri[3 * (size_t)t + (size_t)k] + (size_t)c];
            low[c] = fmin(low[c], x);
            high[c] = fmax(high[c], x);
        }
    }
    locate(g, low, from);
    locate(g, high, to);
    bool meets = true;
    for (int c = 0; c < 3; c++) {
        meets = meets && to[c] >= 0 && from[c] < g->n[c];
        from[c] = from[c] < 0 ? 0 : from[c];
        to[c] = to[c] < g->n[c] ? to[c] : g->n[c] - 1;
    }
    return meets;
}

/* An edge of the triangle has the cube wholly on its outer side, seen along one of the cube's axes (T. Akenine-Moeller,
 * Fast 3D triangle-box overlap testing, 2001). half: of the cube's side. */
static bool passes_by(const grid_triangle *t, const double middle[3], double half)
{
    double v[3][3];
    vec_sub(t->a, middle, v[0]);
    vec_add(v[0], t->e1, v[1]);
    vec_add(v[0], t->e2, v[2]);
    for (int k = 0; k < 3; k++) {
        const double *from = v[k], *to = v[(k + 1) % 3], *other = v[(k + 2) % 3];
        for (int c = 0; c < 3; c++) {
            const int x = (c + 1) % 3, y = (c + 2) % 3;
            double ex = to[x] - from[x], ey = to[y] - from[y], reach = half * (fabs(ex) + fabs(ey)),
                   a = ex * from[y] - ey * from[x], b = ex * other[y] - ey * other[x];
            if ((a > reach && b > reach) || (a < -reach && b < -reach)) return true;
        }
    }
    return false;
}

typedef struct meeting { /* of a cube and a triangle */
    size_t at;           /* the cube's number */
    int32_t triangle;
} meeting;

typedef struct meetings {
    meeting *list;
    size_t count, room;
} meetings;

static void add_meeting(meetings *all, size_t at, int32_t triangle)
{
    if (all->count == all->room) {
        all->room = 2 * all->room + 1024;
        all->list = GROW_ARRAY(meeting, all->list, all->room);
    }
    all->list[all->count++] = (meeting){at, triangle};
}

static void find_meetings(const solid_grid *g, int32_t t, meetings *all)
{
    int32_t i[3], from[3], to[3];
    const grid_triangle x = g->triangle[t];
    double n[3];
    if (!reach(g, t, from, to)) return;
    vec_cross(x.e1, x.e2, n);
    const double half = (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) * g->step / 2 * (1 + 1e-9), level = vec_dot(n, x.a);
    for (i[2] = from[2]; i[2] <= to[2]; i[2]++)
        for (i[1] = from[1]; i[1] <= to[1]; i[1]++)
            for (i[0] = from[0]; i[0] <= to[0]; i[0]++) {
                const double middle[3] = {g->low[0] + g->step * (i[0] + 0.5), g->low[1] + g->step * (i[1] + 0.5),
                                          g->low[2] + g->step * (i[2] + 0.5)};
                if (fabs(vec_dot(n, middle) - level) > half) continue; /* the triangle's plane passes it by */
                if (!passes_by(&x, middle, g->step / 2 * (1 + 1e-9))) add_meeting(all, cell(g, i), t);
            }
}

static void sort_triangles(solid_grid *g, size_t cells)
{
    meetings all = {0};
    g->start = NEW_ARRAY(int32_t, cells + 1);
    for (int32_t t = 0; t < g->s->triangle_count; t++) find_meetings(g, t, &all);
    for (size_t k = 0; k < all.count; k++) g->start[all.list[k].at + 1]++;
    for (size_t c = 0; c < cells; c++) g->start[c + 1] += g->start[c];
    int32_t *fill = COPY_ARRAY(int32_t, g->start, cells);
    g->item = NEW_ARRAY(int32_t, all.count);
    for (size_t k = 0; k < all.count; k++) g->item[fill[all.list[k].at]++] = all.list[k].triangle;
    free(all.list);
    free(fill);
}

static bool is_full(const solid_grid *g, size_t c) { return g->start[c] != g->start[c + 1]; }

/* Of a cube in an array with a rim of one cube all around. */
static size_t rimmed(const solid_grid *g, const int32_t i[3])
{
    return ((size_t)(i[2] + 1) * (size_t)(g->n[1] + 2) + (size_t)(i[1] + 1)) * (size_t)(g->n[0] + 2) +
           (size_t)(i[0] + 1);
}

static uint8_t smaller(uint8_t a, uint8_t b) { return a < b ? a : b; }

/* One of two sweeps: over the rows, each of which learns from the four before it and along itself. */
static void sweep(const solid_grid *g, uint8_t *away, int way)
{
    const int64_t row = g->n[0] + 2, layer = row * (g->n[1] + 2);
    for (int32_t a = 0; a < g->n[2]; a++)
        for (int32_t b = 0; b < g->n[1]; b++) {
            const int32_t first[3] = {0, way > 0 ? b : g->n[1] - 1 - b, way > 0 ? a : g->n[2] - 1 - a};
            uint8_t *restrict at = away + rimmed(g, first);
            const uint8_t *before[4] = {at - way * layer - row, at - way * layer, at - way * layer + row,
                                        at - way * row};
            for (int k = 0; k < 4; k++) {
                const uint8_t *restrict x = before[k];
                for (int32_t i = 0; i < g->n[0]; i++)
                    at[i] = smaller(at[i], (uint8_t)(1 + smaller(smaller(x[i - 1], x[i]), x[i + 1])));
            }
            for (int32_t k = 0; k < g->n[0]; k++) {
                int32_t i = way > 0 ? k : g->n[0] - 1 - k;
                at[i] = smaller(at[i], (uint8_t)(1 + at[i - way]));
            }
        }
}

/* Distances to full cubes, in the array with a rim. */
static uint8_t *find_distances(const solid_grid *g)
{
    size_t count = (size_t)(g->n[0] + 2) * (size_t)(g->n[1] + 2) * (size_t)(g->n[2] + 2);
    uint8_t *away = NEW_ARRAY(uint8_t, count);
    int32_t i[3];
    memset(away, FAR, count);
    for (i[2] = 0; i[2] < g->n[2]; i[2]++)
        for (i[1] = 0; i[1] < g->n[1]; i[1]++)
            for (i[0] = 0; i[0] < g->n[0]; i[0]++)
                if (is_full(g, cell(g, i))) away[rimmed(g, i)] = 0;
    sweep(g, away, 1);
    sweep(g, away, -1);
    return away;
}

/* Whether the first cube's own point of each row is inside: by what lies before it, of which the grid knows nothing. */
static void start_rows(const solid_grid *g, uint8_t *inside)
{
    int32_t i[3], from[3], to[3];
    for (int32_t t = 0; t < g->s->triangle_count; t++) {
        double x = HUGE_VAL, share;
        for (int k = 0; k < 3; k++) x = fmin(x, g->s->xyz[3 * (size_t)g->s->tri[3 * (size_t)t + (size_t)k]]);
        if (x > g->low[0] + g->step) continue;
        const double way[3] = {x - 1 - g->low[0] - g->step, 0, 0}; /* far enough to be outside */
        (void)reach(g, t, from, to);
        i[0] = 0;
        for (i[2] = from[2]; i[2] <= to[2]; i[2]++)
            for (i[1] = from[1]; i[1] <= to[1]; i[1]++) {
                double p[3];
                own_of(g, i, p);
                if (crosses(&g->triangle[t], p, way, &share)) inside[cell(g, i)] ^= 1;
            }
    }
}

/* Along each row of cubes. False if a row that should end outside does not. */
static bool find_inside(const solid_grid *g, bool whole, uint8_t *inside)
{
    int32_t i[3];
    const double way[3] = {g->step, 0, 0};
    const double wall = 1 - own_point[0]; /* the next cube begins at this share of the way */
    start_rows(g, inside);
    for (i[2] = 0; i[2] < g->n[2]; i[2]++)
        for (i[1] = 0; i[1] < g->n[1]; i[1]++) {
            i[0] = 0;
            int in = inside[cell(g, i)];
            for (; i[0] + 1 < g->n[0]; i[0]++) {
                size_t c = cell(g, i);
                if (is_full(g, c) || is_full(g, c + 1)) {
                    double p[3];
                    own_of(g, i, p);
                    in ^= (crossings(g, c, p, way, 0, wall) + crossings(g, c + 1, p, way, wall, 1)) & 1;
                }
                inside[c + 1] = (uint8_t)in;
            }
            if (in && whole) return false;
        }
    return true;
}

/* All in the order of place(), the triangles too. */
static void lay_bricks(solid_grid *g, size_t cells, const uint8_t *inside, const uint8_t *away)
{
    g->cube = NEW_ARRAY(cube, cells);
    int32_t *start = NEW_ARRAY(int32_t, cells + 1), *item = NEW_ARRAY(int32_t, g->start[cells]), i[3], count = 0;
    int32_t *number = NEW_ARRAY(int32_t, g->s->triangle_count); /* of the copy, from 1 on */
    grid_triangle *triangle = NEW_ARRAY(grid_triangle, g->s->triangle_count);
    for (i[2] = 0; i[2] < g->n[2]; i[2]++)
        for (i[1] = 0; i[1] < g->n[1]; i[1]++)
            for (i[0] = 0; i[0] < g->n[0]; i[0]++) {
                g->cube[place(g, i)] = (cube){away[rimmed(g, i)] & FAR, inside[cell(g, i)] & 1};
                start[place(g, i) + 1] = g->start[cell(g, i) + 1] - g->start[cell(g, i)];
            }
    for (size_t c = 0; c < cells; c++) start[c + 1] += start[c];
    for (i[2] = 0; i[2] < g->n[2]; i[2]++)
        for (i[1] = 0; i[1] < g->n[1]; i[1]++)
            for (i[0] = 0; i[0] < g->n[0]; i[0]++)
                for (int32_t k = g->start[cell(g, i)], to = start[place(g, i)]; k < g->start[cell(g, i) + 1]; k++)
                    item[to++] = g->item[k];
    for (int32_t k = 0; k < start[cells]; k++) {
        int32_t t = item[k];
        if (!number[t]) {
            triangle[count] = g->triangle[t];
            number[t] = ++count;
        }
        item[k] = number[t] - 1;
    }
    free(number);
    free(g->start);
    free(g->item);
    free(g->triangle);
    g->start = start;
    g->item = item;
    g->triangle = GROW_ARRAY(grid_triangle, triangle, count + 1);
    g->s = NULL;
}

bool solid_grid_make(const surface *s, double step_mm, const double *box, solid_grid **out, err *e)
{
    if (!s->triangle_count) return err_set(e, ERR_GEOMETRY, "a surface without triangles has no inside");
    solid_grid *g = NEW_ARRAY(solid_grid, 1);
    double high[3];
    bool whole = true;
    g->s = s;
    g->step = step_mm;
    surface_bounds(s, g->low, high);
    size_t cells = 1;
    for (int c = 0; c < 3; c++) {
        whole = whole && (!box || box[3 + c] >= high[c]);
        if (box) {
            g->low[c] = fmax(g->low[c], box[c]);
            high[c] = fmax(fmin(high[c], box[3 + c]), g->low[c]);
        }
        g->low[c] -= 1.5 * step_mm; /* the outermost cubes are empty */
        g->n[c] = ((int32_t)ceil((high[c] - g->low[c]) / step_mm) + 2 + 3) / 4 * 4;
        if (c < 2) g->bricks[c] = (size_t)g->n[c] / 4;
        cells *= (size_t)g->n[c];
    }
    g->triangle = NEW_ARRAY(grid_triangle, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) g->triangle[t] = triangle_of(s, t);
    sort_triangles(g, cells);
    uint8_t *inside = NEW_ARRAY(uint8_t, cells), *away = find_distances(g);
    bool closed = find_inside(g, whole, inside);
    if (closed) lay_bricks(g, cells, inside, away);
    free(inside);
    free(away);
    if (!closed) {
        solid_grid_free(&g);
        return err_set(e, ERR_GEOMETRY, "the surface is not closed");
    }
    *out = g;
    return true;
}
