/* Making a solid_grid: triangles into cubes, distances between cubes, insides along rows. */
#include "geometry/mem.h"
#include "geometry/src/grid_cubes.h"
#include <stdlib.h>

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

/* Counts the triangle in every cube that it may meet, or enters it there once item exists. */
static void enter(solid_grid *g, int32_t t, int32_t *fill)
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
                size_t c = cell(g, i);
                if (fabs(vec_dot(n, middle) - level) > half) continue; /* the triangle's plane passes it by */
                if (g->item)
                    g->item[fill[c]++] = t;
                else
                    g->start[c + 1]++;
            }
}

static void sort_triangles(solid_grid *g, size_t cells)
{
    g->start = NEW_ARRAY(int32_t, cells + 1);
    for (int32_t t = 0; t < g->s->triangle_count; t++) enter(g, t, NULL);
    for (size_t c = 0; c < cells; c++) g->start[c + 1] += g->start[c];
    int32_t *fill = COPY_ARRAY(int32_t, g->start, cells);
    g->item = NEW_ARRAY(int32_t, g->start[cells]);
    for (int32_t t = 0; t < g->s->triangle_count; t++) enter(g, t, fill);
    free(fill);
}

/* Distances to full cubes, by two sweeps over half of the neighbours each. */
static void sweep(solid_grid *g, int way)
{
    int32_t i[3];
    const int64_t row = g->n[0], layer = row * g->n[1];
    int64_t step[13];
    int offset[13][3];
    for (int d = 0; d < 13; d++) { /* the neighbours already passed */
        for (int c = 0, rest = d; c < 3; c++, rest /= 3) offset[d][c] = way * (rest % 3 - 1);
        step[d] = offset[d][0] + row * offset[d][1] + layer * offset[d][2];
    }
    for (int32_t a = 0; a < g->n[2]; a++)
        for (int32_t b = 0; b < g->n[1]; b++)
            for (int32_t c = 0; c < g->n[0]; c++) {
                i[2] = way > 0 ? a : g->n[2] - 1 - a;
                i[1] = way > 0 ? b : g->n[1] - 1 - b;
                i[0] = way > 0 ? c : g->n[0] - 1 - c;
                cube *at = g->cube + cell(g, i);
                int least = at->away;
                if (!least) continue;
                bool edge = a == 0 || b == 0 || c == 0 || a == g->n[2] - 1 || b == g->n[1] - 1 || c == g->n[0] - 1;
                for (int d = 0; d < 13; d++) {
                    const int32_t k[3] = {i[0] + offset[d][0], i[1] + offset[d][1], i[2] + offset[d][2]};
                    if (edge && !within(g, k)) continue;
                    int beside = at[step[d]].away + 1;
                    least = beside < least ? beside : least;
                }
                at->away = (uint8_t)least & FAR;
            }
}

/* Whether the first cube's own point of each row is inside: by what lies before it, of which the grid knows nothing. */
static void start_rows(solid_grid *g)
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
                if (crosses(&g->triangle[t], p, way, &share)) g->cube[cell(g, i)].inside ^= 1;
            }
    }
}

/* Along each row of cubes. False if a row that should end outside does not. */
static bool find_inside(solid_grid *g, bool whole)
{
    int32_t i[3];
    const double way[3] = {g->step, 0, 0};
    const double wall = 1 - own_point[0]; /* the next cube begins at this share of the way */
    start_rows(g);
    for (i[2] = 0; i[2] < g->n[2]; i[2]++)
        for (i[1] = 0; i[1] < g->n[1]; i[1]++) {
            i[0] = 0;
            int in = g->cube[cell(g, i)].inside;
            for (; i[0] + 1 < g->n[0]; i[0]++) {
                size_t c = cell(g, i);
                if (!g->cube[c].away || !g->cube[c + 1].away) {
                    double p[3];
                    own_of(g, i, p);
                    in ^= (crossings(g, c, p, way, 0, wall) + crossings(g, c + 1, p, way, wall, 1)) & 1;
                }
                g->cube[c + 1].inside = in & 1;
            }
            if (in && whole) return false;
        }
    return true;
}

/* All in the order of place(), the triangles too. */
static void lay_bricks(solid_grid *g, size_t cells)
{
    cube *cubes = NEW_ARRAY(cube, cells);
    int32_t *start = NEW_ARRAY(int32_t, cells + 1), *item = NEW_ARRAY(int32_t, g->start[cells]), i[3], count = 0;
    int32_t *number = NEW_ARRAY(int32_t, g->s->triangle_count); /* of the copy, from 1 on */
    grid_triangle *triangle = NEW_ARRAY(grid_triangle, g->s->triangle_count);
    for (i[2] = 0; i[2] < g->n[2]; i[2]++)
        for (i[1] = 0; i[1] < g->n[1]; i[1]++)
            for (i[0] = 0; i[0] < g->n[0]; i[0]++) {
                cubes[place(g, i)] = g->cube[cell(g, i)];
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
    free(g->cube);
    free(g->start);
    free(g->item);
    free(g->triangle);
    g->cube = cubes;
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
    g->cube = NEW_ARRAY(cube, cells);
    for (size_t c = 0; c < cells; c++) g->cube[c].away = g->start[c] == g->start[c + 1] ? FAR : 0;
    sweep(g, 1);
    sweep(g, -1);
    if (!find_inside(g, whole)) {
        solid_grid_free(&g);
        return err_set(e, ERR_GEOMETRY, "the surface is not closed");
    }
    lay_bricks(g, cells);
    *out = g;
    return true;
}
