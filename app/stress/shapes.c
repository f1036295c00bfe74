#include "app/stress/shapes.h"
#include "geometry/vec.h"
#include <math.h>
#include <string.h>

static const double spacing = 4; /* mm, of cusps and teeth */

/* |x|, blended between -e and e. */
typedef struct curve {
    double value, slope, bend;
} curve;
static curve blended_abs(double x, double e)
{
    if (fabs(x) >= e) return (curve){fabs(x), x < 0 ? -1 : 1, 0};
    double t = x / e;
    return (curve){e * (3 + t * t * (6 - t * t)) / 8, t * (3 - t * t) / 2, 1.5 * (1 - t * t) / e};
}

/* How far x is off the nearest tip, blended at tips and valleys. */
static curve off_tip(double x, double e)
{
    double r = remainder(x, spacing), half = spacing / 2;
    if (fabs(r) < half / 2) return blended_abs(r, e);
    curve c = blended_abs(half - fabs(r), e);
    return (curve){half - c.value, r < 0 ? -c.slope : c.slope, -c.bend};
}

static double over_plane(const known_bone *b, const double r[3], double grad[3], double hess[9])
{
    (void)b, (void)hess;
    grad[2] = 1;
    return r[2];
}

static double over_plate(const known_bone *b, const double r[3], double grad[3], double hess[9])
{
    curve c = blended_abs(r[2], b->round);
    grad[2] = c.slope;
    hess[8] = c.bend;
    return c.value - b->size;
}

static double over_ball(const known_bone *b, const double r[3], double grad[3], double hess[9])
{
    double size = vec_norm(r);
    if (!(size > 0)) return HUGE_VAL;
    vec_scale(r, 1 / size, grad);
    for (int i = 0; i < 9; i++) hess[i] = ((i % 4 == 0) - grad[i / 3] * grad[i % 3]) / size;
    return size - b->size;
}

/* The larger of the distances from its two faces. */
static double over_edge(const known_bone *b, const double r[3], double grad[3], double hess[9])
{
    curve c = blended_abs(-r[0] - r[2], b->round);
    grad[0] = -(1 + c.slope) / 2;
    grad[2] = (1 - c.slope) / 2;
    hess[0] = hess[2] = hess[6] = hess[8] = c.bend / 2;
    return (r[2] - r[0] + c.value) / 2;
}

static double over_cusps(const known_bone *b, const double r[3], double grad[3], double hess[9])
{
    double k = 2 * M_PI / spacing, x = k * r[0], y = k * r[1], h = b->size / 2;
    vec_copy((double[]){h * k * sin(x) * cos(y), h * k * cos(x) * sin(y), 1}, grad);
    hess[0] = hess[4] = h * k * k * cos(x) * cos(y);
    hess[1] = hess[3] = -h * k * k * sin(x) * sin(y);
    return r[2] - h * (cos(x) * cos(y) - 1);
}

/* A pyramid falls by the larger of the ways off its tip. */
static double over_teeth(const known_bone *b, const double r[3], double grad[3], double hess[9])
{
    curve x = off_tip(r[0], b->round), y = off_tip(r[1], b->round), c = blended_abs(x.value - y.value, b->round);
    double fall = b->size / (spacing / 2), length = sqrt(1 + fall * fall), half = fall / 2 / length;
    vec_copy((double[]){half * (1 + c.slope) * x.slope, half * (1 - c.slope) * y.slope, 1 / length}, grad);
    hess[0] = half * ((1 + c.slope) * x.bend + c.bend * x.slope * x.slope);
    hess[4] = half * ((1 - c.slope) * y.bend + c.bend * y.slope * y.slope);
    hess[1] = hess[3] = -half * c.bend * x.slope * y.slope;
    return r[2] / length + half * (x.value + y.value + c.value);
}

static double distance(const void *context, const double x[3], double grad[3], double *hess)
{
    static double (*const over[])(const known_bone *b, const double r[3], double grad[3], double hess[9]) = {
        [KNOWN_PLANE] = over_plane, [KNOWN_PLATE] = over_plate, [KNOWN_BALL] = over_ball,
        [KNOWN_EDGE] = over_edge,   [KNOWN_CUSPS] = over_cusps, [KNOWN_TEETH] = over_teeth};
    const known_bone *b = context;
    double r[3], bend[9] = {0};
    vec_sub(x, b->at, r);
    memset(grad, 0, 3 * sizeof *grad);
    double d = over[b->kind](b, r, grad, bend);
    if (hess) memcpy(hess, bend, sizeof bend);
    return d;
}

/* By steps and halving: bones and gaps along the way that are thinner than a step may be missed. */
static bool leave(const void *context, const double x[3], const double direction[3], double reach_mm, double hit[3],
                  double normal[3])
{
    static const double step_mm = 0.02, near_mm = 1e-12;
    double inside = HUGE_VAL, outside = HUGE_VAL, p[3], grad[3];
    bool was_inside = distance(context, x, grad, NULL) < 0;
    for (int k = 0; k * step_mm < reach_mm; k++) {
        double way = fmin(reach_mm, (k + 1) * step_mm);
        vec_axpy(x, way, direction, p);
        bool is_inside = distance(context, p, grad, NULL) < 0;
        if (was_inside && !is_inside) inside = k * step_mm, outside = way;
        was_inside = is_inside;
    }
    if (inside == HUGE_VAL) return false;
    while (outside - inside > near_mm * (1 + outside)) {
        double way = (inside + outside) / 2;
        vec_axpy(x, way, direction, p);
        if (distance(context, p, grad, NULL) < 0)
            inside = way;
        else
            outside = way;
    }
    vec_axpy(x, outside, direction, hit);
    distance(context, hit, normal, NULL);
    return vec_normalize(normal) > 0;
}

bone_shape known_shape(const known_bone *b) { return (bone_shape){.context = b, .distance = distance, .leave = leave}; }
