/* The axes of a head from its jaws alone, before there are landmarks: a mandible is alike on both sides, grows wider
 * towards the back, and hangs below the skull. */
#include "app/planner/patient/check_parts.h"
#include "geometry/vec.h"

enum { SAMPLES = 400 };

typedef struct axes { /* numbers of axes and their signs */
    int side, up, back;
    double up_sign, back_sign;
} axes;

static void middle_of(const surface *s, double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (int32_t v = 0; v < s->vertex_count; v++) vec_axpy(out, 1.0 / s->vertex_count, s->xyz + 3 * (size_t)v, out);
}

/* The axis about whose middle plane the surface is alike on both sides; -1: none stands out. */
static int side_axis(const surface *s, const nearest *tree)
{
    const double clear = 2; /* times more alike than about the other axes */
    double low[3], high[3], least = HUGE_VAL, second = HUGE_VAL;
    int best = 0, count = s->vertex_count < SAMPLES ? s->vertex_count : SAMPLES;
    surface_bounds(s, low, high);
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0;
        for (int k = 0; k < count; k++) {
            double x[3];
            vec_copy(s->xyz + 3 * ((int64_t)k * s->vertex_count / count), x);
            x[axis] = low[axis] + high[axis] - x[axis];
            sum += nearest_point(tree, x, NULL, NULL);
        }
        second = fmin(second, fmax(sum, least));
        if (sum >= least) continue;
        least = sum;
        best = axis;
    }
    return second > clear * least ? best : -1;
}

/* Slope of the distance from the middle plane over the two other axes, least squares. */
static void widening(const surface *s, int side, const double middle[3], double slope[2])
{
    const int a = (side + 1) % 3, b = (side + 2) % 3;
    double aa = 0, ab = 0, bb = 0, aw = 0, bw = 0, mean = 0;
    for (int32_t v = 0; v < s->vertex_count; v++)
        mean += fabs(s->xyz[3 * (size_t)v + (size_t)side] - middle[side]) / s->vertex_count;
    for (int32_t v = 0; v < s->vertex_count; v++) {
        double d[3];
        vec_sub(s->xyz + 3 * (size_t)v, middle, d);
        double w = fabs(d[side]) - mean;
        aa += d[a] * d[a];
        ab += d[a] * d[b];
        bb += d[b] * d[b];
        aw += d[a] * w;
        bw += d[b] * w;
    }
    double det = aa * bb - ab * ab;
    slope[0] = det > 0 ? (aw * bb - bw * ab) / det : 0;
    slope[1] = det > 0 ? (bw * aa - aw * ab) / det : 0;
}

/* False where the shapes do not tell. */
static bool find_axes(const surface *skull, const surface *mandible, const nearest *tree, axes *out)
{
    const double least_slope = 0.1, least_rise_mm = 10, clear = 0.3;
    axes x = {.side = side_axis(mandible, tree)};
    if (x.side < 0) return false;
    const int other[2] = {(x.side + 1) % 3, (x.side + 2) % 3};
    double jaw[3], head[3], slope[2], rise[2];
    middle_of(mandible, jaw);
    middle_of(skull, head);
    widening(mandible, x.side, jaw, slope);
    for (int k = 0; k < 2; k++) rise[k] = head[other[k]] - jaw[other[k]];
    double wide = hypot(slope[0], slope[1]), high = hypot(rise[0], rise[1]);
    if (wide < least_slope || high < least_rise_mm) return false;
    double first_is_back = (fabs(slope[0]) - fabs(slope[1])) / wide + (fabs(rise[1]) - fabs(rise[0])) / high;
    if (fabs(first_is_back) < clear) return false; /* a head that is turned by about 45 degrees */
    int back = first_is_back > 0 ? 0 : 1;
    x.back = other[back];
    x.up = other[1 - back];
    x.back_sign = slope[back] < 0 ? -1 : 1;
    x.up_sign = rise[1 - back] < 0 ? -1 : 1;
    *out = x;
    return true;
}

bool check_axes(const surface *skull, const surface *mandible, const nearest *tree, bool sure, const char *file,
                issue_list *issues)
{
    axes x;
    if (!find_axes(skull, mandible, tree, &x)) return true;
    if (x.side == 0 && x.up == 2 && x.up_sign > 0 && x.back_sign > 0) return true;
    bool ras = x.side == 0 && x.up == 2 && x.up_sign > 0, y_up = x.side == 0 && x.up == 1 && x.up_sign > 0;
    issue_add(issues, sure ? ISSUE_ERROR : ISSUE_WARNING, ERR_GEOMETRY, file, 0, NULL,
              "the jaws lie as if %c were from side to side, %c%c up and %c%c the back; x, +z and +y would be right "
              "(LPS)%s",
              'x' + x.side, x.up_sign < 0 ? '-' : '+', 'x' + x.up, x.back_sign < 0 ? '-' : '+', 'x' + x.back,
              ras    ? ": are they in RAS? Say \"frame\": \"RAS\" or --frame ras"
              : y_up ? ": are they y up? (x, y, z) -> (x, -z, y) would mend it"
                     : "");
    return false;
}
