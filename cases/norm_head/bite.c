#include "bite.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include "teeth.h"
#include <assert.h>
#include <stdlib.h>

enum { CANINE = 2, SHELLS = 2 * TEETH_PER_SIDE };
static const double down_mm = 2.5, canine_up_mm = 1, up_mm = 3, touch_mm = 0.05, step_mm = 0.25;

typedef struct contest { /* a lower tooth against the upper arch: the vertices of each that could touch the
                            other */
    nearest *upper, *lower;
    double *of_lower, *of_upper;
    int lower_count, upper_count;
} contest;

/* The points within `reach` of the box, in a new array. */
static double *near_box(const surface *s, const double low[3], const double high[3], double reach, int *count)
{
    double *out = NEW_ARRAY(double, 3 * s->vertex_count);
    *count = 0;
    for (int32_t i = 0; i < s->vertex_count; i++) {
        const double *p = s->xyz + 3 * i;
        bool near = true;
        for (int c = 0; c < 3; c++) near = near && p[c] > low[c] - reach && p[c] < high[c] + reach;
        if (near) vec_copy(p, out + 3 * (*count)++);
    }
    return out;
}

static bool contest_make(nearest *upper_tree, const surface *upper, const surface *one, contest *out, err *e)
{
    contest c = {.upper = upper_tree};
    if (!nearest_create(one, &c.lower, e)) return false;
    double low[3], high[3], arch_low[3], arch_high[3];
    surface_bounds(one, low, high);
    surface_bounds(upper, arch_low, arch_high);
    c.of_upper = near_box(upper, low, high, up_mm + 1, &c.upper_count);
    c.of_lower = near_box(one, arch_low, arch_high, up_mm + 1, &c.lower_count);
    *out = c;
    return true;
}

static void contest_free(contest *c)
{
    nearest_destroy(&c->lower);
    free(c->of_lower);
    free(c->of_upper);
}

/* Least distance of the points, moved up by `by`, from the surface of the tree; negative: the deepest inside.
 */
static double least_gap(const nearest *tree, const double *xyz, int count, double by)
{
    double least = HUGE_VAL;
    for (int i = 0; i < count; i++) {
        double p[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2] + by}, d = nearest_point(tree, p, NULL, NULL);
        if (d < down_mm && nearest_inside(tree, p)) d = -d;
        least = fmin(least, d);
    }
    return least;
}

static double gap(const contest *c, double lift)
{
    return fmin(least_gap(c->upper, c->of_lower, c->lower_count, lift),
                least_gap(c->lower, c->of_upper, c->upper_count, -lift));
}

/* The lowest height at which the tooth touches, else the highest that it may take. */
static double find_lift(const contest *c, double most_mm)
{
    double low = -down_mm, high = low;
    while (high < most_mm && gap(c, high) > touch_mm) {
        low = high;
        high += step_mm;
    }
    if (gap(c, high) > touch_mm) return most_mm;
    for (int i = 0; i < 5 && high > low; i++) {
        double middle = (low + high) / 2;
        if (gap(c, middle) > touch_mm)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static surface shell_of(const surface *teeth, int number)
{
    int32_t vertices = teeth->vertex_count / SHELLS, triangles = teeth->triangle_count / SHELLS;
    surface one = surface_new(vertices, triangles);
    for (int32_t i = 0; i < 3 * vertices; i++) one.xyz[i] = teeth->xyz[3 * vertices * number + i];
    for (int32_t i = 0; i < 3 * triangles; i++) one.tri[i] = teeth->tri[3 * triangles * number + i] - vertices * number;
    return one;
}

static int shell_nearest(const surface *teeth, const double p[3])
{
    int32_t best = 0;
    for (int32_t i = 1; i < teeth->vertex_count; i++)
        if (vec_distance(teeth->xyz + 3 * i, p) < vec_distance(teeth->xyz + 3 * best, p)) best = i;
    return (int)(best / (teeth->vertex_count / SHELLS));
}

bool bite_settle(const surface *upper, surface *lower, const place *list, int count, landmarks *points, err *e)
{
    assert(lower->vertex_count % SHELLS == 0 && lower->triangle_count % SHELLS == 0);
    nearest *tree = NULL;
    if (!nearest_create(upper, &tree, e)) return false;
    double lift[SHELLS] = {0};
    bool ok = true;
    for (int i = 0; ok && i < SHELLS; i++) {
        int number = i % TEETH_PER_SIDE;
        if (number < CANINE) continue;
        surface one = shell_of(lower, i);
        contest c = {0};
        ok = contest_make(tree, upper, &one, &c, e);
        if (ok) lift[i] = find_lift(&c, number == CANINE ? canine_up_mm : up_mm);
        contest_free(&c);
        surface_free(&one);
    }
    nearest_destroy(&tree);
    if (!ok) return false;
    for (int i = 0; i < count; i++) {
        if (list[i].on != ON_LOWER_TEETH) continue;
        double p[3];
        vec_copy(landmarks_find(points, list[i].label)->xyz, p);
        p[2] += lift[shell_nearest(lower, p)];
        landmarks_set(points, list[i].label, p);
    }
    for (int32_t i = 0; i < lower->vertex_count; i++) lower->xyz[3 * i + 2] += lift[i / (lower->vertex_count / SHELLS)];
    return true;
}
