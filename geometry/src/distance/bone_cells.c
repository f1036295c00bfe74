#include "geometry/src/distance/bone_cells.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double corner_share = 0.8661; /* of a cube's side: its middle to a corner */
enum { SIDE = 4, PROBES = 3 };             /* cells along a block, test points along a cell at the surface */

/* The lattice's axes: turned about (1, 2, 3) by 1 rad, which no symmetric body shares. */
static rigid lattice(void)
{
    const double origin[3] = {0, 0, 0};
    double axis[3] = {1, 2, 3};
    vec_normalize(axis);
    return rigid_rotation(origin, axis, 1);
}

static void put(bone_cells *b, const double middle[3], double mm3)
{
    if ((b->count & (b->count - 1)) == 0) b->lump = GROW_ARRAY(double, b->lump, 8 * ((size_t)b->count + 1));
    double *l = b->lump + 4 * (size_t)b->count++;
    vec_copy(middle, l);
    l[3] = mm3;
}

/* One cell with its middle at `at` (lattice axes). */
static void fill_cell(bone_cells *b, const solid_grid *g, const rigid *axes, const double at[3], double h)
{
    double p[3], sum[3] = {0};
    rigid_apply(axes, at, p);
    if (solid_grid_clear(g, p) > corner_share * h) {
        if (solid_grid_inside(g, p)) put(b, p, h * h * h);
        return;
    }
    int inside = 0;
    for (int i = 0; i < PROBES * PROBES * PROBES; i++) {
        const int k[3] = {i % PROBES, i / PROBES % PROBES, i / PROBES / PROBES};
        double q[3];
        for (int c = 0; c < 3; c++) q[c] = at[c] + h * ((k[c] + 0.5) / PROBES - 0.5);
        rigid_apply(axes, q, p);
        if (!solid_grid_inside(g, p)) continue;
        vec_add(sum, p, sum);
        inside++;
    }
    if (!inside) return;
    vec_scale(sum, 1.0 / inside, sum);
    put(b, sum, h * h * h * inside / (PROBES * PROBES * PROBES));
}

/* Of the lumps from `first` on. */
static bone_block block_around(const bone_cells *b, int32_t first)
{
    bone_block k = {.first = first, .count = b->count - first};
    for (int32_t i = first; i < b->count; i++) vec_axpy(k.centre, 1.0 / k.count, b->lump + 4 * (size_t)i, k.centre);
    for (int32_t i = first; i < b->count; i++)
        k.radius = fmax(k.radius, vec_distance(k.centre, b->lump + 4 * (size_t)i));
    return k;
}

/* The cells with the middles low + cell_mm (from .. from + 2, + 1/2), lattice axes. */
static void fill_part(bone_cells *b, const solid_grid *g, const rigid *axes, const double low[3], const int from[3],
                      double h)
{
    int32_t first = b->count;
    for (int k = 0; k < 8; k++) {
        double at[3];
        for (int c = 0; c < 3; c++) at[c] = low[c] + h * (from[c] + (k >> c & 1) + 0.5);
        fill_cell(b, g, axes, at, h);
    }
    if (b->count == first) return;
    b->part = GROW_ARRAY(bone_block, b->part, b->part_count + 1);
    b->part[b->part_count++] = block_around(b, first);
}

static void fill_block(bone_cells *b, const solid_grid *g, const rigid *axes, const double low[3], const int block[3],
                       double h)
{
    int32_t first = b->count, first_part = b->part_count;
    for (int k = 0; k < 8; k++) {
        int from[3];
        for (int c = 0; c < 3; c++) from[c] = SIDE * block[c] + 2 * (k >> c & 1);
        fill_part(b, g, axes, low, from, h);
    }
    if (b->count == first) return;
    b->block = GROW_ARRAY(bone_block, b->block, b->block_count + 1);
    bone_block *k = &b->block[b->block_count++];
    *k = block_around(b, first);
    k->first = first_part;
    k->count = b->part_count - first_part;
}

/* Lumps so scaled that their sum is the body's volume: the surface is sampled, and errs by a little either way. */
static void balance(bone_cells *b, double mm3)
{
    double sum = 0;
    for (int32_t i = 0; i < b->count; i++) sum += b->lump[4 * (size_t)i + 3];
    for (int32_t i = 0; i < b->count && sum > 0; i++) b->lump[4 * (size_t)i + 3] *= mm3 / sum;
    for (bone_block *p = b->part; p < b->part + b->part_count; p++)
        for (int32_t i = 0; i < p->count; i++) p->mm3 += b->lump[4 * (size_t)(p->first + i) + 3];
    for (bone_block *k = b->block; k < b->block + b->block_count; k++)
        for (int32_t i = 0; i < k->count; i++) k->mm3 += b->part[k->first + i].mm3;
}

bone_cells bone_cells_make(const surface *s, const solid_grid *grid, double cell_mm)
{
    bone_cells b = {0};
    rigid axes = lattice(), back = rigid_inverse(&axes);
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int32_t v = 0; v < s->vertex_count; v++) {
        double p[3];
        rigid_apply(&back, s->xyz + 3 * (size_t)v, p);
        for (int c = 0; c < 3; c++) {
            low[c] = fmin(low[c], p[c]);
            high[c] = fmax(high[c], p[c]);
        }
    }
    int n[3], i[3];
    const double side = SIDE * cell_mm;
    for (int c = 0; c < 3; c++) n[c] = (int)ceil((high[c] - low[c]) / side);
    for (i[2] = 0; i[2] < n[2]; i[2]++)
        for (i[1] = 0; i[1] < n[1]; i[1]++)
            for (i[0] = 0; i[0] < n[0]; i[0]++) {
                double at[3], p[3];
                for (int c = 0; c < 3; c++) at[c] = low[c] + side * (i[c] + 0.5);
                rigid_apply(&axes, at, p);
                if (solid_grid_clear(grid, p) > corner_share * side && !solid_grid_inside(grid, p)) continue;
                fill_block(&b, grid, &axes, low, i, cell_mm);
            }
    balance(&b, surface_volume(s));
    return b;
}

void bone_cells_free(bone_cells *b)
{
    free(b->lump);
    free(b->part);
    free(b->block);
    *b = (bone_cells){0};
}

/* All of the block is on one side of the surface: how much of it is inside. */
static bool settled(const bone_block *k, const solid_grid *other, const rigid *move, double *mm3)
{
    double p[3];
    rigid_apply(move, k->centre, p);
    if (solid_grid_clear(other, p) <= k->radius) return false;
    *mm3 += solid_grid_inside(other, p) ? k->mm3 : 0;
    return true;
}

double bone_cells_inside(const bone_cells *b, const solid_grid *other, const rigid *move)
{
    double sum = 0;
    for (const bone_block *k = b->block; k < b->block + b->block_count; k++) {
        if (settled(k, other, move, &sum)) continue;
        for (const bone_block *p = b->part + k->first; p < b->part + k->first + k->count; p++) {
            if (settled(p, other, move, &sum)) continue;
            for (int32_t i = p->first; i < p->first + p->count; i++) {
                double at[3];
                rigid_apply(move, b->lump + 4 * (size_t)i, at);
                if (solid_grid_inside(other, at)) sum += b->lump[4 * (size_t)i + 3];
            }
        }
    }
    return sum;
}
