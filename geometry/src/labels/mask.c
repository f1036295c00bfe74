#include "geometry/mask.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

mask mask_new(const int32_t size[3])
{
    mask m = {.size = {size[0], size[1], size[2]}};
    m.on = NEW_ARRAY(uint8_t, mask_voxels(&m));
    return m;
}

void mask_free(mask *m)
{
    free(m->on);
    *m = (mask){0};
}

int64_t mask_voxels(const mask *m) { return (int64_t)m->size[0] * m->size[1] * m->size[2]; }

int64_t mask_count(const mask *m)
{
    int64_t n = 0, voxels = mask_voxels(m);
    for (int64_t i = 0; i < voxels; i++) n += m->on[i];
    return n;
}

void mask_add_label(mask *m, const volume *v, int32_t label, int32_t layer)
{
    int64_t voxels = mask_voxels(m);
    const int16_t *value = v->value + layer * voxels;
    for (int64_t i = 0; i < voxels; i++) m->on[i] |= value[i] == label;
}

void mask_add_above(mask *m, const volume *v, double value)
{
    int64_t voxels = mask_voxels(m);
    for (int64_t i = 0; i < voxels; i++) m->on[i] |= v->value[i] > value;
}

typedef struct flood { /* walks a component; the stack is kept between walks */
    const int32_t *size;
    int64_t *stack;
    size_t capacity;
    bool corners; /* 26 neighbours, else 6 */
} flood;

static void push(flood *f, size_t *top, int64_t voxel)
{
    if (*top == f->capacity) {
        f->capacity = f->capacity ? 2 * f->capacity : 4096;
        f->stack = GROW_ARRAY(int64_t, f->stack, f->capacity);
    }
    f->stack[(*top)++] = voxel;
}

/* Gives `to` to every voxel of value `from` that is joined with the seed; returns how many. */
static int64_t flood_from(flood *f, uint8_t *value, int64_t seed, uint8_t from, uint8_t to)
{
    const int64_t nx = f->size[0], ny = f->size[1], nz = f->size[2];
    if (value[seed] != from) return 0;
    size_t top = 0;
    int64_t count = 0;
    value[seed] = to;
    push(f, &top, seed);
    while (top) {
        int64_t at = f->stack[--top], i = at % nx, j = at / nx % ny, k = at / (nx * ny);
        count++;
        for (int dk = -1; dk <= 1; dk++)
            for (int dj = -1; dj <= 1; dj++)
                for (int di = -1; di <= 1; di++) {
                    int64_t a = i + di, b = j + dj, c = k + dk;
                    if (!f->corners && abs(di) + abs(dj) + abs(dk) != 1) continue;
                    if (a < 0 || a >= nx || b < 0 || b >= ny || c < 0 || c >= nz) continue;
                    int64_t to_voxel = (c * ny + b) * nx + a;
                    if (value[to_voxel] != from) continue;
                    value[to_voxel] = to;
                    push(f, &top, to_voxel);
                }
    }
    return count;
}

/* Marks used while walking; on and off stay 1 and 0 outside. */
enum { MARK = 2, KEEP = 3 };

int32_t mask_drop_islands(mask *m, int64_t least, int64_t *voxels)
{
    flood f = {.size = m->size, .corners = true};
    int64_t all = mask_voxels(m);
    int32_t islands = 0;
    *voxels = 0;
    for (int64_t i = 0; i < all; i++) {
        int64_t n = flood_from(&f, m->on, i, 1, MARK);
        if (!n) continue;
        bool drop = n < least;
        flood_from(&f, m->on, i, MARK, drop ? 0 : KEEP);
        islands += drop;
        if (drop) *voxels += n;
    }
    for (int64_t i = 0; i < all; i++) m->on[i] = m->on[i] == KEEP;
    free(f.stack);
    return islands;
}

int32_t mask_keep_largest(mask *m)
{
    flood f = {.size = m->size};
    int64_t all = mask_voxels(m), most = 0, seed = -1;
    int32_t components = 0;
    for (int64_t i = 0; i < all; i++) {
        int64_t n = flood_from(&f, m->on, i, 1, MARK);
        components += n > 0;
        if (n <= most) continue;
        most = n;
        seed = i;
    }
    if (seed >= 0) flood_from(&f, m->on, seed, MARK, KEEP);
    for (int64_t i = 0; i < all; i++) m->on[i] = m->on[i] == KEEP;
    free(f.stack);
    return components ? components - 1 : 0;
}

/* On a face of the volume across an axis that counts. */
static bool on_face(const mask *m, int64_t voxel, const bool axis[3])
{
    int64_t nx = m->size[0], ny = m->size[1], at[3] = {voxel % nx, voxel / nx % ny, voxel / (nx * ny)};
    for (int a = 0; a < 3; a++)
        if (axis[a] && (at[a] == 0 || at[a] == m->size[a] - 1)) return true;
    return false;
}

int64_t mask_fill_cavities(mask *m)
{
    const bool every[3] = {true, true, true};
    flood f = {.size = m->size};
    int64_t all = mask_voxels(m), filled = 0;
    for (int64_t i = 0; i < all; i++)
        if (!m->on[i] && on_face(m, i, every)) flood_from(&f, m->on, i, 0, MARK);
    for (int64_t i = 0; i < all; i++) {
        filled += m->on[i] == 0;
        m->on[i] = m->on[i] != MARK;
    }
    free(f.stack);
    return filled;
}

/* Lower envelope of the parabolas d[q] + (w (x - q))^2 along one line: Felzenszwalb and Huttenlocher,
 * "Distance transforms of sampled functions", Theory of Computing 8 (2012), section 2. */
static void distance_line(const float *d, float *out, int n, double w, int *apex, double *from)
{
    int last = -1;
    for (int q = 0; q < n; q++) {
        if (!(d[q] < HUGE_VALF)) continue;
        double meet = -HUGE_VAL;
        while (last >= 0) {
            int p = apex[last];
            meet = ((double)d[q] - (double)d[p]) / (2 * w * w * (q - p)) + (q + p) / 2.0;
            if (meet > from[last]) break;
            meet = -HUGE_VAL;
            last--;
        }
        apex[++last] = q;
        from[last] = meet;
    }
    if (last < 0) {
        for (int x = 0; x < n; x++) out[x] = HUGE_VALF;
        return;
    }
    for (int x = 0, k = 0; x < n; x++) {
        while (k < last && from[k + 1] < x) k++;
        double r = w * (x - apex[k]);
        out[x] = (float)((double)d[apex[k]] + r * r);
    }
}

typedef struct distance_pass {
    const int32_t *size;
    int axis;
    double spacing;
    float *square;
} distance_pass;

static void distance_lines(int64_t begin, int64_t end, void *context)
{
    const distance_pass *p = context;
    int n = p->size[p->axis];
    int64_t nx = p->size[0], ny = p->size[1], stride = p->axis == 0 ? 1 : p->axis == 1 ? nx : nx * ny;
    float *in = NEW_ARRAY(float, n), *out = NEW_ARRAY(float, n);
    int *apex = NEW_ARRAY(int, n);
    double *from = NEW_ARRAY(double, n);
    for (int64_t line = begin; line < end; line++) {
        int64_t start = p->axis == 0 ? line * nx : p->axis == 1 ? line / nx * nx * ny + line % nx : line;
        for (int k = 0; k < n; k++) in[k] = p->square[start + k * stride];
        distance_line(in, out, n, p->spacing, apex, from);
        for (int k = 0; k < n; k++) p->square[start + k * stride] = out[k];
    }
    free(in);
    free(out);
    free(apex);
    free(from);
}

/* Square of the distance in mm from each voxel to the nearest one of value `to`; the caller frees. */
static float *square_distance(const mask *m, uint8_t to, const double spacing[3])
{
    int64_t all = mask_voxels(m);
    float *square = NEW_ARRAY(float, all);
    for (int64_t i = 0; i < all; i++) square[i] = m->on[i] == to ? 0 : HUGE_VALF;
    for (int a = 0; a < 3; a++) {
        distance_pass pass = {m->size, a, spacing[a], square};
        parallel_for(all / m->size[a], 256, distance_lines, &pass);
    }
    return square;
}

void mask_seal(mask *m, const volume *grid, double radius_mm)
{
    int64_t all = mask_voxels(m);
    double spacing[3];
    bool side[3];
    for (int a = 0; a < 3; a++) {
        spacing[a] = vec_norm(grid->step[a]);
        side[a] = fabs(grid->step[a][2]) < 0.7 * spacing[a];
    }
    float limit = (float)(radius_mm * radius_mm), *square = square_distance(m, 1, spacing);
    mask ball = mask_new(m->size); /* 0: the centre of the ball fits here; MARK: and it gets here */
    for (int64_t i = 0; i < all; i++) ball.on[i] = square[i] < limit;
    free(square);
    flood f = {.size = m->size};
    for (int64_t i = 0; i < all; i++)
        if (!ball.on[i] && on_face(m, i, side)) flood_from(&f, ball.on, i, 0, MARK);
    free(f.stack);
    square = square_distance(&ball, MARK, spacing);
    for (int64_t i = 0; i < all; i++) m->on[i] |= !(square[i] < limit);
    free(square);
    mask_free(&ball);
}

int64_t mask_contacts(const mask *a, const mask *b)
{
    int64_t nx = a->size[0], ny = a->size[1], nz = a->size[2], count = 0;
    const int64_t stride[3] = {1, nx, nx * ny};
    for (int64_t k = 0; k < nz; k++)
        for (int64_t j = 0; j < ny; j++)
            for (int64_t i = 0; i < nx; i++) {
                int64_t at = (k * ny + j) * nx + i;
                const bool next[3] = {i + 1 < nx, j + 1 < ny, k + 1 < nz};
                for (int c = 0; c < 3; c++)
                    if (next[c]) count += (a->on[at] && b->on[at + stride[c]]) || (b->on[at] && a->on[at + stride[c]]);
            }
    return count;
}

bool mask_bounds(const mask *m, int32_t low[3], int32_t high[3])
{
    int32_t nx = m->size[0], ny = m->size[1], nz = m->size[2];
    bool found = false;
    for (int c = 0; c < 3; c++) {
        low[c] = INT32_MAX;
        high[c] = -1;
    }
    for (int32_t k = 0; k < nz; k++)
        for (int32_t j = 0; j < ny; j++)
            for (int32_t i = 0; i < nx; i++) {
                if (!m->on[((int64_t)k * ny + j) * nx + i]) continue;
                const int32_t at[3] = {i, j, k};
                for (int c = 0; c < 3; c++) {
                    if (at[c] < low[c]) low[c] = at[c];
                    if (at[c] > high[c]) high[c] = at[c];
                }
                found = true;
            }
    return found;
}
