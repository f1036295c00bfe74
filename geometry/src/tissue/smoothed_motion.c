#include "geometry/smoothed_motion.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

enum { NEIGHBOURS = 40 };
static const double sigma_mm = 12, share = 0.85, cell_mm = 4;

typedef struct bone_grid { /* vertices in cubes: those of cell c are order[start[c] .. start[c+1]) */
    int32_t count, size[3], *start, *order;
    double low[3], *xyz, *moved; /* [3*count] */
} bone_grid;

static int32_t along(const bone_grid *g, double x, int axis)
{
    double i = floor((x - g->low[axis]) / cell_mm);
    return i < 0 ? 0 : i >= g->size[axis] ? g->size[axis] - 1 : (int32_t)i;
}

static size_t cell_of(const bone_grid *g, const double p[3])
{
    return ((size_t)along(g, p[2], 2) * (size_t)g->size[1] + (size_t)along(g, p[1], 1)) * (size_t)g->size[0] +
           (size_t)along(g, p[0], 0);
}

static void grid_free(bone_grid *g)
{
    free(g->start);
    free(g->order);
    free(g->xyz);
    free(g->moved);
}

static bone_grid grid_make(const segments *at_rest, const rigid move[SEGMENT_COUNT], int32_t count)
{
    bone_grid g = {.count = count, .low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    g.xyz = NEW_ARRAY(double, 3 * (size_t)count);
    g.moved = NEW_ARRAY(double, 3 * (size_t)count);
    g.order = NEW_ARRAY(int32_t, count);
    size_t i = 0;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        for (int32_t v = 0; v < at_rest->part[s].vertex_count; v++, i += 3) {
            double to[3];
            vec_copy(at_rest->part[s].xyz + 3 * (size_t)v, g.xyz + i);
            rigid_apply(&move[s], g.xyz + i, to);
            vec_sub(to, g.xyz + i, g.moved + i);
            for (int c = 0; c < 3; c++) {
                g.low[c] = fmin(g.low[c], g.xyz[i + (size_t)c]);
                high[c] = fmax(high[c], g.xyz[i + (size_t)c]);
            }
        }
    size_t cells = 1;
    for (int c = 0; c < 3; c++) {
        g.size[c] = 1 + (int32_t)((high[c] - g.low[c]) / cell_mm);
        cells *= (size_t)g.size[c];
    }
    g.start = NEW_ARRAY(int32_t, cells + 1);
    for (int32_t v = 0; v < count; v++) g.start[cell_of(&g, g.xyz + 3 * (size_t)v) + 1]++;
    for (size_t c = 0; c < cells; c++) g.start[c + 1] += g.start[c];
    int32_t *next = COPY_ARRAY(int32_t, g.start, cells + 1);
    for (int32_t v = 0; v < count; v++) g.order[next[cell_of(&g, g.xyz + 3 * (size_t)v)]++] = v;
    free(next);
    return g;
}

typedef struct neighbour {
    double square;
    int32_t vertex;
} neighbour;

/* Keeps the list sorted by distance, then number. */
static void offer(neighbour list[NEIGHBOURS], int *held, neighbour n)
{
    int i = *held;
    if (i == NEIGHBOURS) {
        const neighbour *last = list + NEIGHBOURS - 1;
        if (n.square > last->square || (n.square == last->square && n.vertex > last->vertex)) return;
        i--;
    } else {
        ++*held;
    }
    for (;
         i > 0 && (list[i - 1].square > n.square || (list[i - 1].square == n.square && list[i - 1].vertex > n.vertex));
         i--)
        list[i] = list[i - 1];
    list[i] = n;
}

/* Cells in cubic shells about p's own until nothing outside can be nearer than the farthest held. */
static void find_neighbours(const bone_grid *g, const double p[3], neighbour list[NEIGHBOURS])
{
    int held = 0;
    int32_t centre[3], reach_max = 0;
    for (int c = 0; c < 3; c++) {
        centre[c] = along(g, p[c], c);
        reach_max = g->size[c] > reach_max ? g->size[c] : reach_max;
    }
    for (int32_t reach = 0; reach <= reach_max; reach++) {
        double clear = cell_mm * (reach - 1); /* what lies in this shell is at least this far along one axis */
        if (held == NEIGHBOURS && clear > 0 && clear * clear > list[NEIGHBOURS - 1].square) return;
        for (int32_t z = centre[2] - reach; z <= centre[2] + reach; z++)
            for (int32_t y = centre[1] - reach; y <= centre[1] + reach; y++) {
                bool face = abs(z - centre[2]) == reach || abs(y - centre[1]) == reach;
                if (z < 0 || y < 0 || z >= g->size[2] || y >= g->size[1]) continue;
                for (int32_t x = centre[0] - reach; x <= centre[0] + reach; x += face || !reach ? 1 : 2 * reach) {
                    if (x < 0 || x >= g->size[0]) continue;
                    size_t cell = ((size_t)z * (size_t)g->size[1] + (size_t)y) * (size_t)g->size[0] + (size_t)x;
                    for (int32_t k = g->start[cell]; k < g->start[cell + 1]; k++) {
                        double d[3];
                        vec_sub(g->xyz + 3 * (size_t)g->order[k], p, d);
                        offer(list, &held, (neighbour){vec_dot(d, d), g->order[k]});
                    }
                }
            }
    }
}

typedef struct motion_job {
    const bone_grid *grid;
    const surface *skin;
    const uint8_t *selected;
    double *after;
} motion_job;

static void carry(int64_t begin, int64_t end, void *context)
{
    const motion_job *j = context;
    for (int64_t v = begin; v < end; v++) {
        const double *p = j->skin->xyz + 3 * v;
        vec_copy(p, j->after + 3 * v);
        if (!j->selected[v]) continue;
        neighbour list[NEIGHBOURS];
        double sum = 0, moved[3] = {0};
        find_neighbours(j->grid, p, list);
        for (int i = 0; i < NEIGHBOURS; i++) { /* relative to the nearest: far skin must not divide 0 by 0 */
            double w = exp((list[0].square - list[i].square) / (2 * sigma_mm * sigma_mm));
            vec_axpy(moved, w, j->grid->moved + 3 * (size_t)list[i].vertex, moved);
            sum += w;
        }
        vec_axpy(p, share / sum, moved, j->after + 3 * v);
    }
}

bool smoothed_motion(const surface *skin, const uint8_t *selected, const segments *at_rest,
                     const rigid move[SEGMENT_COUNT], double *after, err *e)
{
    int32_t count = 0;
    for (int s = 0; s < SEGMENT_COUNT; s++) count += at_rest->part[s].vertex_count;
    if (count < NEIGHBOURS)
        return err_set(e, ERR_GEOMETRY, "the segments have %d vertices; the smoothed motion needs %d", count,
                       NEIGHBOURS);
    bone_grid g = grid_make(at_rest, move, count);
    motion_job job = {&g, skin, selected, after};
    parallel_for(skin->vertex_count, 64, carry, &job);
    grid_free(&g);
    return true;
}
