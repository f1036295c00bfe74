#include "geometry/src/files/join_corners.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

static const double open_most = 0.1;               /* share of open sides of a scan with its holes: 0.05 */
static const double loose_most = 0.5;              /* beyond it there is no surface to repair */
static const double reach_mm[] = {0, 0.001, 0.01}; /* files keep 3 to 6 decimals of a mm */
static const double reach_share = 0.05;            /* of the mean side: a surface in metres is not crushed */
static const double vertices_most = 0.7;           /* per triangle: a closed surface has 0.5 */

typedef struct cells { /* open addressing: the kept vertices by the cube they lie in */
    const double *xyz;
    double size;
    size_t mask;
    int32_t *first, *next; /* first [mask + 1], next [vertices]; -1 ends a list */
} cells;

static size_t slot_of(const cells *c, const int64_t at[3])
{
    uint64_t h = 0;
    for (int k = 0; k < 3; k++) h = (h ^ (uint64_t)at[k]) * 0x9E3779B97F4A7C15u;
    return (size_t)(h >> 20) & c->mask;
}

static void cell_of(const cells *c, int32_t v, int64_t at[3])
{
    for (int k = 0; k < 3; k++) at[k] = (int64_t)fmax(-1e15, fmin(1e15, floor(c->xyz[3 * (size_t)v + k] / c->size)));
}

/* The nearest kept vertex within the size of a cell, or -1. */
static int32_t near_one(const cells *c, int32_t v)
{
    int64_t here[3];
    double least = c->size;
    int32_t found = -1;
    cell_of(c, v, here);
    for (int i = 0; i < 27; i++) {
        const int64_t at[3] = {here[0] + i % 3 - 1, here[1] + i / 3 % 3 - 1, here[2] + i / 9 - 1};
        for (int32_t w = c->first[slot_of(c, at)]; w >= 0; w = c->next[w]) {
            double d = vec_distance(c->xyz + 3 * (size_t)v, c->xyz + 3 * (size_t)w);
            if (d > least || (found >= 0 && d == least && w > found)) continue;
            least = d;
            found = w;
        }
    }
    return found;
}

/* Moves each vertex to the first one near it, so that both are at the same place; returns how many moved. */
static int32_t draw_together(surface *s, double reach)
{
    size_t slots = 1;
    while (slots < 2 * (size_t)s->vertex_count) slots *= 2;
    cells c = {s->xyz, reach, slots - 1, NEW_ARRAY(int32_t, slots), NEW_ARRAY(int32_t, s->vertex_count)};
    int32_t moved = 0;
    for (size_t i = 0; i < slots; i++) c.first[i] = -1;
    for (int32_t v = 0; v < s->vertex_count; v++) {
        int64_t at[3];
        int32_t near = near_one(&c, v);
        if (near < 0) {
            cell_of(&c, v, at);
            size_t slot = slot_of(&c, at);
            c.next[v] = c.first[slot];
            c.first[slot] = v;
        } else if (vec_distance(s->xyz + 3 * (size_t)v, s->xyz + 3 * (size_t)near) > 0) {
            vec_copy(s->xyz + 3 * (size_t)near, s->xyz + 3 * (size_t)v);
            moved++;
        }
    }
    free(c.first);
    free(c.next);
    return moved;
}

static double open_share(const surface *s)
{
    int32_t open, crowded;
    if (s->vertex_count <= vertices_most * s->triangle_count || !s->triangle_count) return 0;
    surface_edge_census(s, &open, &crowded);
    return open / (3.0 * s->triangle_count);
}

static double mean_side(const surface *s)
{
    double sum = 0;
    for (int32_t i = 0; i < 3 * s->triangle_count; i++) {
        int32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        sum += vec_distance(s->xyz + 3 * (size_t)a, s->xyz + 3 * (size_t)b);
    }
    return sum / (3.0 * s->triangle_count);
}

bool join_corners(surface *s, const char *path, corner_join *done, err *e)
{
    double open = open_share(s), most = 0;
    *done = (corner_join){0};
    if (open > open_most) most = reach_share * mean_side(s);
    for (size_t i = 0; i < sizeof reach_mm / sizeof *reach_mm && open > open_most; i++) {
        double reach = fmin(reach_mm[i], most);
        mesh_file_report same = {0};
        int32_t moved = reach > 0 ? draw_together(s, reach) : 0;
        if (moved) done->distance_mm = reach;
        done->joined_vertices += moved;
        mesh_weld(s, &same);
        open = open_share(s);
    }
    if (open > loose_most && s->triangle_count >= JOIN_REFUSED_FROM)
        return err_at(
            e, ERR_GEOMETRY, path, 0, NULL,
            "is %d loose triangles, not a surface: %.0f %% of their sides meet no other within %g mm; save it "
            "with shared corners",
            s->triangle_count, 100 * open, reach_mm[sizeof reach_mm / sizeof *reach_mm - 1]);
    return true;
}
