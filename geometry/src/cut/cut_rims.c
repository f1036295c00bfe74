#include "geometry/cut_rims.h"
#include "geometry/mem.h"
#include "geometry/triangle.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double sharp_cosine = 0.766; /* of 40 degrees */

static bool same_bone(int a, int b)
{
    bool skull_a = a == SEGMENT_CRANIUM || a == SEGMENT_MAXILLA, skull_b = b == SEGMENT_CRANIUM || b == SEGMENT_MAXILLA;
    return a != b && skull_a == skull_b;
}

typedef struct cell_point { /* a vertex and the cube it lies in */
    int32_t cell[3];
    const double *xyz;
} cell_point;

static int compare_cells(const void *a, const void *b)
{
    const int32_t *p = ((const cell_point *)a)->cell, *q = ((const cell_point *)b)->cell;
    for (int k = 0; k < 3; k++)
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

static cell_point in_cell(const double *xyz, double side)
{
    cell_point c = {.xyz = xyz};
    for (int k = 0; k < 3; k++) c.cell[k] = (int32_t)floor(xyz[k] / side);
    return c;
}

/* Vertices of the segments cut from the same bone as segment s, sorted by cell. */
static cell_point *neighbours_of(const segments *all, int s, double side, size_t *count)
{
    *count = 0;
    for (int o = 0; o < SEGMENT_COUNT; o++)
        if (same_bone(s, o)) *count += (size_t)all->part[o].vertex_count;
    cell_point *out = NEW_ARRAY(cell_point, *count);
    size_t n = 0;
    for (int o = 0; o < SEGMENT_COUNT; o++)
        for (size_t v = 0; same_bone(s, o) && v < (size_t)all->part[o].vertex_count; v++)
            out[n++] = in_cell(all->part[o].xyz + 3 * v, side);
    qsort(out, n, sizeof *out, compare_cells);
    return out;
}

static bool any_near(const cell_point *sorted, size_t count, const double p[3], double reach)
{
    cell_point home = in_cell(p, reach);
    for (int k = 0; k < 9; k++) { /* columns of three cells, which lie one after the other */
        cell_point want = {.cell = {home.cell[0] + k / 3 - 1, home.cell[1] + k % 3 - 1, home.cell[2] - 1}};
        size_t low = 0, high = count;
        while (low < high) {
            size_t middle = (low + high) / 2;
            if (compare_cells(&sorted[middle], &want) < 0)
                low = middle + 1;
            else
                high = middle;
        }
        want.cell[2] += 2;
        for (; low < count && compare_cells(&sorted[low], &want) <= 0; low++)
            if (vec_distance(sorted[low].xyz, p) <= reach) return true;
    }
    return false;
}

typedef struct half_edge {
    int32_t low, high, triangle;
} half_edge;

static int compare_edges(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

static void find_rim(const surface *s, const uint8_t *near, double **piece, int *count)
{
    size_t edges = 0;
    half_edge *edge = NEW_ARRAY(half_edge, 3 * (size_t)s->triangle_count);
    for (int32_t i = 0; i < 3 * s->triangle_count; i++) {
        int32_t a = s->tri[i], b = s->tri[i / 3 * 3 + (i + 1) % 3];
        if (near[a] && near[b]) edge[edges++] = (half_edge){a < b ? a : b, a < b ? b : a, i / 3};
    }
    qsort(edge, edges, sizeof *edge, compare_edges);
    double *out = NEW_ARRAY(double, 3 * edges); /* two half edges make one piece */
    int n = 0;
    for (size_t i = 0; i + 1 < edges; i++) {
        if (edge[i].low != edge[i + 1].low || edge[i].high != edge[i + 1].high) continue;
        double a[3], b[3];
        triangle_normal(s, edge[i].triangle, a);
        triangle_normal(s, edge[++i].triangle, b);
        if (vec_dot(a, b) > sharp_cosine) continue;
        vec_copy(s->xyz + 3 * (size_t)edge[i].low, out + 6 * n);
        vec_copy(s->xyz + 3 * (size_t)edge[i].high, out + 6 * n + 3);
        n++;
    }
    free(edge);
    *piece = out;
    *count = n;
}

cut_rims cut_rims_find(const segments *at_rest, double reach_mm)
{
    cut_rims out = {0};
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        const surface *part = &at_rest->part[s];
        size_t others;
        if (!part->triangle_count) continue;
        cell_point *sorted = neighbours_of(at_rest, s, reach_mm, &others);
        uint8_t *near = NEW_ARRAY(uint8_t, part->vertex_count);
        for (size_t v = 0; others && v < (size_t)part->vertex_count; v++)
            near[v] = any_near(sorted, others, part->xyz + 3 * v, reach_mm);
        find_rim(part, near, &out.piece[s], &out.count[s]);
        free(near);
        free(sorted);
    }
    return out;
}

void cut_rims_free(cut_rims *r)
{
    for (int s = 0; s < SEGMENT_COUNT; s++) free(r->piece[s]);
    *r = (cut_rims){0};
}
