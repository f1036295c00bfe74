#include "tube.h"
#include "geometry/mem.h"
#include "sdf.h"
#include <stdlib.h>

/* The ball around balls[count] about the middle of their box. */
static double ball_around(const double (*balls)[4], int count, double centre[3])
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, reach = 0;
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            low[c] = sdf_min(low[c], balls[i][c]);
            high[c] = sdf_max(high[c], balls[i][c]);
        }
    for (int c = 0; c < 3; c++) centre[c] = (low[c] + high[c]) / 2;
    for (int i = 0; i < count; i++) reach = sdf_max(reach, vec_distance(balls[i], centre) + balls[i][3]);
    return reach;
}

tube tube_round(const double (*control)[4], int count)
{
    tube t = {.count = (count - 1) * TUBE_STEPS + 1, .flat = 1};
    t.ball = mem_alloc((size_t)t.count, sizeof *t.ball);
    t.stretch = mem_alloc((size_t)count - 1, sizeof *t.stretch);
    for (int i = 0; i < t.count; i++) sdf_spline(control[0], 4, count, (double)i / TUBE_STEPS, t.ball[i]);
    for (int i = 0; i + 1 < count; i++)
        t.stretch[i][3] = ball_around((const double(*)[4])t.ball + TUBE_STEPS * i, TUBE_STEPS + 1, t.stretch[i]);
    t.reach = ball_around((const double(*)[4])t.ball, t.count, t.centre);
    return t;
}

tube tube_flat(const double (*control)[4], int count, const double across[3], double flat)
{
    tube t = tube_round(control, count);
    vec_copy(across, t.across);
    vec_normalize(t.across);
    t.reach *= sdf_max(flat, 1);
    t.flat = flat;
    return t;
}

void tube_free(tube *t)
{
    free(t->ball);
    free(t->stretch);
    *t = (tube){0};
}

/* Ellipse with semi-axes r*flat along the axis of w and r across it, to first order. */
static double flat_distance(double w, double rest, double r, double flat)
{
    double u = w / flat, k0 = sqrt(u * u + rest * rest) / r, k1 = sqrt(u * u / (flat * flat) + rest * rest) / (r * r);
    return k1 < 1e-9 ? -r : k0 * (k0 - 1) / k1;
}

/* Distance of the cone from ball a to ball b. */
static double piece_distance(const tube *t, const double a[4], const double b[4], const double p[3])
{
    double ab[3], q[3];
    vec_sub(b, a, ab);
    vec_sub(p, a, q);
    double s = sdf_clamp(vec_dot(q, ab) / vec_dot(ab, ab), 0, 1), r = sdf_mix(a[3], b[3], s);
    vec_axpy(q, -s, ab, q);
    if (t->flat == 1) return vec_norm(q) - r;
    double w = vec_dot(q, t->across);
    vec_axpy(q, -w, t->across, q);
    return flat_distance(w, vec_norm(q), r, t->flat);
}

/* The distance where it is less than `limit`, else limit or more. */
static double distance_below(const tube *t, const double p[3], double limit)
{
    double best = limit;
    for (int i = 0; i + 1 < t->count; i++) {
        const double *around = t->stretch[i / TUBE_STEPS];
        /* the bound does not hold for the first-order distance of a flat section */
        if (i % TUBE_STEPS == 0 && t->flat == 1 && vec_distance(p, around) - around[3] > best)
            i += TUBE_STEPS - 1;
        else
            best = sdf_min(best, piece_distance(t, t->ball[i], t->ball[i + 1], p));
    }
    return best;
}

double tube_distance(const tube *t, const double p[3]) { return distance_below(t, p, HUGE_VAL); }

/* Farther than k from d, a blend leaves d as it is. */
double tube_union(double d, const tube *t, const double p[3], double k)
{
    double least = vec_distance(p, t->centre) - t->reach;
    return least > d + k ? d : sdf_union(d, distance_below(t, p, d + k), k);
}

double tube_cut(double d, const tube *t, const double p[3], double k)
{
    double least = vec_distance(p, t->centre) - t->reach;
    return least > k - d ? d : sdf_cut(d, distance_below(t, p, k - d), k);
}
