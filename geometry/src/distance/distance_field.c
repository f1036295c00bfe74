#include "geometry/mem.h"
#include "geometry/src/distance/distance_blocks.h"
#include "geometry/vec.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

int64_t block_grid(const double low[3], const double high[3], double step_mm, double reach_mm, double first[3],
                   int32_t blocks[3])
{
    int64_t count = 1;
    for (int c = 0; c < 3; c++) {
        first[c] = low[c] - reach_mm - 2 * step_mm;
        blocks[c] = (int32_t)ceil((high[c] + reach_mm + 3 * step_mm - first[c]) / (SIDE * step_mm));
        count *= blocks[c];
    }
    return count;
}

distance_field *distance_field_create(const nearest *of, const double low[3], const double high[3], double step_mm,
                                      double reach_mm)
{
    assert(step_mm > 0 && reach_mm >= 0);
    distance_field *f = NEW_ARRAY(distance_field, 1);
    f->of = of;
    f->step = step_mm;
    f->reach = reach_mm;
    size_t count = (size_t)block_grid(low, high, step_mm, reach_mm, f->low, f->blocks);
    f->block = mem_alloc(count, sizeof *f->block);
    f->centre = mem_alloc(count, sizeof *f->centre);
    for (size_t b = 0; b < count; b++) atomic_init(&f->centre[b], (float)NAN);
    return f;
}

void distance_field_destroy(distance_field **f)
{
    if (!*f) return;
    size_t count = (size_t)(*f)->blocks[0] * (size_t)(*f)->blocks[1] * (size_t)(*f)->blocks[2];
    const distance_samples *lent = (*f)->lent;
    for (int32_t k = 0; lent && k < lent->count; k++) atomic_store(&(*f)->block[lent->block[k]], NULL);
    for (size_t b = 0; b < count; b++) free((void *)atomic_load(&(*f)->block[b]));
    free((void *)(*f)->block);
    free((void *)(*f)->centre);
    free(*f);
    *f = NULL;
}

/* The way to a neighbour passes the surface only if both are together no farther from it than the way is long: else a
 * sample takes the side of its neighbour; the others are asked. */
static float *find_block(const distance_field *f, const int32_t at[3])
{
    static const int back[3] = {1, SIDE, SIDE * SIDE};
    const float apart = (float)(f->step * (1 + 1e-5));
    float *value = NEW_ARRAY(float, BLOCK);
    double place[BLOCK][3];
    int32_t triangle[BLOCK];
    for (int s = 0; s < BLOCK; s++) {
        int k[3] = {s % SIDE, s / SIDE % SIDE, s / (SIDE * SIDE)};
        double x[3];
        int known = -1;
        for (int c = 0; c < 3; c++) x[c] = f->low[c] + f->step * (SIDE * at[c] + k[c]);
        int beside = s - back[k[0] > 0 ? 0 : k[1] > 0 ? 1 : 2];
        if (s > 0) {
            vec_copy(place[beside], place[s]);
            triangle[s] = triangle[beside];
            value[s] = (float)nearest_point_onward(f->of, x, place[s], &triangle[s]);
        } else
            value[s] = (float)nearest_point(f->of, x, place[s], &triangle[s]);
        for (int c = 0; c < 3; c++)
            if (k[c] > 0 && fabsf(value[s - back[c]]) + value[s] > apart) known = s - back[c];
        if (known >= 0 ? value[known] < 0 : nearest_inside(f->of, x)) value[s] = -value[s];
    }
    return value;
}

bool block_is_far(const distance_field *f, const int32_t at[3])
{
    size_t slot = block_slot(f, at);
    float d = atomic_load(&f->centre[slot]);
    double side = SIDE * f->step;
    if (isnan(d)) {
        double x[3];
        for (int c = 0; c < 3; c++) x[c] = f->low[c] + side * at[c] + (SIDE - 1) * f->step / 2;
        d = (float)nearest_point(f->of, x, NULL, NULL);
        if ((double)d > f->reach && nearest_inside(f->of, x)) d = -d;
        atomic_store(&f->centre[slot], d);
    }
    return (double)d > f->reach + side * sqrt(3) / 2;
}

/* Two threads may find the same block at the same time: the values are the same, one copy stays. */
const float *block_get(const distance_field *f, const int32_t at[3])
{
    _Atomic(const float *) *slot = &f->block[block_slot(f, at)];
    const float *there = atomic_load(slot);
    if (there) return there;
    float *found = find_block(f, at);
    if (atomic_compare_exchange_strong(slot, &there, found)) return found;
    free(found);
    return there;
}

/* Weights of four samples about t in [0, 1) between the middle two, with first and second derivatives. */
static void spline_weights(double t, double w[3][4])
{
    double s = 1 - t;
    w[0][0] = s * s * s / 6;
    w[0][1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    w[0][2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
    w[0][3] = t * t * t / 6;
    w[1][0] = -s * s / 2;
    w[1][1] = (-4 * t + 3 * t * t) / 2;
    w[1][2] = (4 * s - 3 * s * s) / 2;
    w[1][3] = t * t / 2;
    w[2][0] = s;
    w[2][1] = 3 * t - 2;
    w[2][2] = 3 * s - 2;
    w[2][3] = t;
}

/* The 64 samples about x. */
static void gather(const distance_field *f, const int32_t first[3], double sample[64])
{
    const float *held = NULL;
    int32_t held_at[3] = {-1, -1, -1};
    for (int s = 0; s < 64; s++) {
        int32_t k[3] = {first[0] + s % 4, first[1] + s / 4 % 4, first[2] + s / 16}, at[3];
        for (int c = 0; c < 3; c++) at[c] = k[c] / SIDE;
        if (at[0] != held_at[0] || at[1] != held_at[1] || at[2] != held_at[2]) {
            held = block_get(f, at);
            for (int c = 0; c < 3; c++) held_at[c] = at[c];
        }
        sample[s] = (double)held[(k[2] % SIDE * SIDE + k[1] % SIDE) * SIDE + k[0] % SIDE];
    }
}

void distance_field_at(const distance_field *f, const double x[3], bool with_hess, distance_value *out)
{
    double w[3][3][4], sample[64], hess[6] = {0}; /* xx, yy, zz, yz, xz, xy */
    int32_t first[3], block[3];
    out->d = HUGE_VAL;
    for (int c = 0; c < 3; c++) {
        double at = (x[c] - f->low[c]) / f->step;
        if (!(at >= 1 && at < SIDE * f->blocks[c] - 2)) return;
        first[c] = (int32_t)at - 1;
        block[c] = (int32_t)at / SIDE;
        spline_weights(at - floor(at), w[c]);
    }
    if (block_is_far(f, block)) return;
    gather(f, first, sample);
    out->d = 0;
    for (int c = 0; c < 3; c++) out->grad[c] = 0;
    for (int s = 0; s < 64; s++) {
        static const int order[6][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};
        int i = s % 4, j = s / 4 % 4, k = s / 16;
        out->d += w[0][0][i] * w[1][0][j] * w[2][0][k] * sample[s];
        out->grad[0] += w[0][1][i] * w[1][0][j] * w[2][0][k] * sample[s];
        out->grad[1] += w[0][0][i] * w[1][1][j] * w[2][0][k] * sample[s];
        out->grad[2] += w[0][0][i] * w[1][0][j] * w[2][1][k] * sample[s];
        for (int h = 0; with_hess && h < 6; h++)
            hess[h] += w[0][order[h][0]][i] * w[1][order[h][1]][j] * w[2][order[h][2]][k] * sample[s];
    }
    vec_scale(out->grad, 1 / f->step, out->grad);
    if (!with_hess) return;
    static const int place[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
    for (int n = 0; n < 9; n++) out->hess[n] = hess[place[n]] / (f->step * f->step);
}

bool distance_field_leave(const distance_field *f, const double x[3], const double direction[3], double reach_mm,
                          double hit[3], double normal[3])
{
    enum { CROSSINGS = 16 };
    static const double past_mm = 1e-3; /* a crossing is left behind by so much */
    double from[3], at[3];
    bool found = false;
    vec_copy(x, from);
    for (int k = 0; k < CROSSINGS && nearest_ray(f->of, from, direction, at, NULL); k++) {
        distance_value v;
        if (vec_distance(x, at) > reach_mm) break;
        distance_field_at(f, at, false, &v);
        if (isfinite(v.d) && vec_dot(v.grad, direction) > 0 && vec_norm(v.grad) > 0) {
            vec_copy(at, hit);
            vec_copy(v.grad, normal);
            vec_normalize(normal);
            found = true;
        }
        vec_axpy(at, past_mm, direction, from);
    }
    return found;
}
