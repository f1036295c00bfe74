#include "app/planner/patient/check_fit.h"
#include "geometry/mem.h"
#include "geometry/triangle.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

enum { STEPS = 40, UNKNOWNS = 6 };
static const double kept_share = 0.8, still_mm = 1e-6;

double fit_distance(const fit_body *b, const double p[3], double point[3], double normal[3])
{
    double least = HUGE_VAL;
    for (int i = 0; i < b->count; i++) {
        double at[3];
        int32_t triangle;
        double d = nearest_point(b->tree[i], p, at, &triangle);
        if (d >= least) continue;
        least = d;
        if (point) vec_copy(at, point);
        if (normal) triangle_normal(b->mesh[i], triangle, normal);
    }
    return least;
}

typedef struct pair {
    double at[3], gap[3], normal[3], distance;
} pair;

static int by_size(const void *a, const void *b)
{
    double x = ((const pair *)a)->distance, y = ((const pair *)b)->distance;
    return (x > y) - (x < y);
}

/* Sorted, nearest first; returns how many count. */
static int pair_up(const fit_body *b, const double *p, int count, const fit_way *way, pair *out, double *mean)
{
    int kept = (int)ceil(kept_share * count);
    for (int i = 0; i < count; i++) {
        double on[3];
        mat_apply(way->m, p + 3 * (size_t)i, out[i].at);
        vec_add(out[i].at, way->t, out[i].at);
        out[i].distance = fit_distance(b, out[i].at, on, out[i].normal);
        vec_sub(on, out[i].at, out[i].gap);
    }
    qsort(out, (size_t)count, sizeof *out, by_size);
    *mean = 0;
    for (int i = 0; i < kept; i++) *mean += out[i].distance / kept;
    return kept;
}

/* Symmetric and, with a little on its diagonal, positive: elimination without pivots. */
static void solve(int n, double a[UNKNOWNS][UNKNOWNS], double x[UNKNOWNS])
{
    double trace = 0;
    for (int k = 0; k < n; k++) trace += a[k][k];
    for (int k = 0; k < n; k++) a[k][k] += 1e-6 * trace + 1e-12;
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) {
            double f = a[i][k] / a[k][k];
            for (int c = k; c < n; c++) a[i][c] -= f * a[k][c];
            x[i] -= f * x[k];
        }
    for (int k = n - 1; k >= 0; k--) {
        for (int c = k + 1; c < n; c++) x[k] -= a[k][c] * x[c];
        x[k] /= a[k][k];
    }
}

/* The small change of place that closes the gaps along the normals best. Returns how far it moves the points, mm. */
static double step(const pair *p, int kept, fit_freedom freedom, fit_way *way)
{
    double middle[3] = {0}, spread = 0, a[UNKNOWNS][UNKNOWNS] = {{0}}, x[UNKNOWNS] = {0};
    for (int i = 0; i < kept; i++) vec_axpy(middle, 1.0 / kept, p[i].at, middle);
    for (int i = 0; i < kept; i++) spread += vec_distance(p[i].at, middle) / kept;
    if (!(spread > 0)) return 0;
    for (int i = 0; i < kept; i++) {
        double arm[3], row[UNKNOWNS];
        vec_sub(p[i].at, middle, arm);
        vec_scale(arm, 1 / spread, arm);
        vec_copy(p[i].normal, row);
        if (freedom == FIT_SCALE) row[3] = vec_dot(arm, p[i].normal);
        if (freedom == FIT_TURN) vec_cross(arm, p[i].normal, row + 3);
        for (int r = 0; r < (int)freedom; r++) {
            for (int c = 0; c < (int)freedom; c++) a[r][c] += row[r] * row[c];
            x[r] += row[r] * vec_dot(p[i].gap, p[i].normal);
        }
    }
    solve((int)freedom, a, x);
    double change[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, moved = vec_norm(x), old[9], shift[3];
    if (freedom == FIT_SCALE) {
        for (int c = 0; c < 3; c++) change[4 * c] += x[3] / spread;
        moved += fabs(x[3]);
    } else if (freedom == FIT_TURN) {
        double axis[3] = {x[3] / spread, x[4] / spread, x[5] / spread}, angle = vec_normalize(axis);
        moved += angle * spread;
        if (angle > 0) memcpy(change, rigid_rotation(middle, axis, angle).r, sizeof change);
    }
    memcpy(old, way->m, sizeof old);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            way->m[3 * r + c] = 0;
            for (int k = 0; k < 3; k++) way->m[3 * r + c] += change[3 * r + k] * old[3 * k + c];
        }
    vec_sub(way->t, middle, shift);
    mat_apply(change, shift, way->t);
    for (int c = 0; c < 3; c++) way->t[c] += middle[c] + x[c];
    return moved;
}

double fit_points(const fit_body *b, const double *p, int count, fit_freedom freedom, fit_way *way)
{
    pair *pairs = NEW_ARRAY(pair, count);
    double best;
    fit_way at = *way;
    int kept = pair_up(b, p, count, &at, pairs, &best);
    for (int i = 0; freedom && i < STEPS; i++) {
        double mean, moved = step(pairs, kept, freedom, &at);
        kept = pair_up(b, p, count, &at, pairs, &mean);
        if (mean < best) {
            best = mean;
            *way = at;
        }
        if (!(moved > still_mm)) break;
    }
    free(pairs);
    return best;
}
