#include "app/planner/identity/head_place.h"
#include "app/planner/identity/place_search.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A head is at most a fifth smaller and a quarter larger than another. 4.5 mm: heads lie 2.5 to 3.5 mm off the mean
 * one, a ball 5. */
static const double least_scale = 0.8, most_scale = 1.25, most_median_mm = 4.5, off_mm = 12;
static const double head_least_mm = 150, head_most_mm = 600, usual_mm = 350; /* corner to corner of a skin */

static bool check_size(const surface *skin, err *e)
{
    static const struct {
        double mm;
        const char *name;
    } units[] = {{1000, "metres"}, {10, "centimetres"}, {25.4, "inches"}};
    double low[3], high[3];
    if (!skin->triangle_count) return err_set(e, ERR_GEOMETRY, "the scan has no skin to recognise a head by");
    surface_bounds(skin, low, high);
    double d = vec_distance(low, high);
    if (d >= head_least_mm && d <= head_most_mm) return true;
    int best = 0; /* the unit that makes it most like a usual head */
    for (int i = 1; i < 3; i++)
        if (fabs(log(d * units[i].mm / usual_mm)) < fabs(log(d * units[best].mm / usual_mm))) best = i;
    if (d * units[best].mm >= head_least_mm && d * units[best].mm <= head_most_mm)
        return err_set(e, ERR_GEOMETRY,
                       "the skin measures %.3g corner to corner, a head in %s; save it in mm (times %g)", d,
                       units[best].name, units[best].mm);
    return err_set(e, ERR_GEOMETRY, "the skin measures %.4g mm corner to corner; a head measures %g to %g mm", d,
                   head_least_mm, head_most_mm);
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Weighted anew by what is left, so that a misplaced landmark does not count (Cauchy's weights about the median).
 * Returns the median of what is left, mm. */
static double fit_robust(const double *from, const double *to, int32_t count, similarity *out)
{
    enum { ROUNDS = 12 };
    const double floor_mm = 0.5;
    double *weight = NEW_ARRAY(double, count), *left = NEW_ARRAY(double, count), median = 0;
    for (int32_t i = 0; i < count; i++) weight[i] = 1;
    for (int round = 0; round < ROUNDS; round++) {
        similarity_of_pairs(from, to, weight, count, true, out);
        for (int32_t i = 0; i < count; i++) {
            double x[3];
            similarity_apply(out, from + 3 * (size_t)i, x);
            left[i] = weight[i] = vec_distance(x, to + 3 * (size_t)i);
        }
        qsort(left, (size_t)count, sizeof *left, by_size);
        median = left[count / 2];
        double usual = fmax(median, floor_mm);
        for (int32_t i = 0; i < count; i++) weight[i] = 1 / (1 + weight[i] * weight[i] / (usual * usual));
    }
    free(weight);
    free(left);
    return median;
}

/* Spread of points across their best plane, mm. */
static double thickness(const double *x, int32_t count)
{
    double middle[3] = {0}, least = HUGE_VAL;
    for (int32_t i = 0; i < count; i++) vec_axpy(middle, 1.0 / count, x + 3 * (size_t)i, middle);
    for (int k = 0; k < 500; k++) { /* of evenly spread directions the one of least spread */
        double z = (k + 0.5) / 500, turn = 2.399963 * k, r = sqrt(1 - z * z), sum = 0;
        const double n[3] = {r * cos(turn), r * sin(turn), z};
        for (int32_t i = 0; i < count; i++) {
            double u[3];
            vec_sub(x + 3 * (size_t)i, middle, u);
            sum += vec_dot(u, n) * vec_dot(u, n) / count;
        }
        least = fmin(least, sqrt(sum));
    }
    return least;
}

/* True: *way by landmarks. Refused: e is filled. */
static bool by_landmarks(const head_template *t, const head_scan *s, similarity *way, err *e)
{
    const double mirror_gain = 0.5, flat_mm = 5;
    double *from = NEW_ARRAY(double, 3 * t->point_count), *to = NEW_ARRAY(double, 3 * t->point_count);
    int32_t n = 0;
    for (int32_t i = 0; i < t->point_count; i++) {
        const landmark *p = landmarks_find(&s->points, t->point[i].label);
        if (!p) continue;
        vec_copy(t->point[i].at, from + 3 * (size_t)n);
        vec_copy(p->xyz, to + 3 * (size_t)n++);
    }
    bool enough = n >= 4 && thickness(from, n) > flat_mm;
    if (enough) {
        similarity mirrored;
        double left = fit_robust(from, to, n, way);
        for (int32_t i = 0; i < n; i++) from[3 * i] *= -1;
        double left_mirrored = fit_robust(from, to, n, &mirrored);
        if (left_mirrored < mirror_gain * left)
            err_set(
                e, ERR_GEOMETRY,
                "the head is mirrored, left for right: its landmarks lie %.1f mm off as they are, %.1f mm mirrored; "
                "mirror it back",
                left, left_mirrored);
    }
    free(from);
    free(to);
    return enough && !e->code;
}

static bool check_facing(const place_found *f, err *e)
{
    const double inward = -0.3;
    int there = 0, turned = 0;
    char which[64] = "";
    for (int i = 0; i < PLACE_PARTS; i++) {
        there += f->alike[i] != 0;
        if (!(f->alike[i] < inward)) continue;
        size_t n = strlen(which);
        snprintf(which + n, sizeof which - n, "%s%s", turned++ ? ", " : "", case_surface_name((case_surface)i));
    }
    if (!turned) return true;
    if (turned == there)
        return err_set(
            e, ERR_GEOMETRY,
            "the head is mirrored, left for right: its surfaces face inwards (%s), as they do after x -> -x; "
            "mirror it back, or turn the triangles over if it is not",
            which);
    return err_set(e, ERR_GEOMETRY, "the %s faces inwards: turn its triangles over", which);
}

/* The turn of whole axes that is nearest to the head's: out[3*r + c], 0 or +-1. */
static void nearest_axes(const double r[9], double out[9])
{
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    double most = -HUGE_VAL;
    for (int k = 0; k < 48; k++) {
        double m[9] = {0}, sum = 0;
        for (int i = 0; i < 3; i++) m[3 * i + order[k / 8][i]] = k >> i & 1 ? -1 : 1;
        for (int i = 0; i < 9; i++) sum += m[i] * r[i];
        if (mat_det(m) < 0 || sum <= most) continue;
        most = sum;
        memcpy(out, m, sizeof m);
    }
}

static void tell(const similarity *way, char told[256])
{
    double m[9];
    char axes[32];
    size_t n = 0;
    const double *r = way->motion.r;
    nearest_axes(r, m);
    told[0] = 0;
    if (m[0] + m[4] + m[8] > 2.5) return; /* as it should be */
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            if (m[3 * k + c] != 0)
                n += (size_t)snprintf(axes + n, sizeof axes - n, "%s%s%c", c ? ", " : "(", m[3 * k + c] < 0 ? "-" : "",
                                      'x' + k);
    snprintf(axes + n, sizeof axes - n, ")");
    const char *what = m[0] < 0 && m[4] < 0                ? "in RAS"
                       : m[0] > 0 && m[4] < 0              ? "upside down"
                       : m[4] > 0 && m[0] < 0              ? "upside down, back to front"
                       : m[0] > 0 && m[5] != 0 && m[7] < 0 ? "y up"
                                                           : "in other axes";
    double turn = rigid_angle(&way->motion) * 180 / M_PI;
    snprintf(told, 256, "the head lies %s, turned by %.0f degrees: (x, y, z) -> %s would mend it%s", what, turn, axes,
             m[0] < 0 && m[4] < 0 ? ", or \"frame\": \"RAS\" in the case" : "");
}

bool head_place_find(const head_template *t, const head_scan *s, const task *watch, head_place *out, char told[256],
                     err *e)
{
    place_bodies b;
    place_found found = {.way = similarity_identity()};
    err why = {0};
    if (!check_size(&s->part[CASE_SKIN], e)) return false;
    bool pointed = by_landmarks(t, s, &found.way, &why);
    if (why.code) return err_set(e, why.code, "%s", why.text);
    if (!place_bodies_make(t, s, &b, e)) return false;
    bool ok = true;
    if (pointed)
        place_measure(&b, &found);
    else
        ok = place_search(&b, watch, &found) || err_set(e, ERR_INTERRUPTED, "interrupted");
    place_bodies_free(&b);
    if (!ok) return false;
    if (found.median_mm > (pointed ? off_mm : most_median_mm))
        return err_set(e, ERR_GEOMETRY,
                       "the surfaces are no head that is known: half of them lies more than %.1f mm off "
                       "the mean head, wherever that is laid",
                       found.median_mm);
    if (found.way.scale < least_scale || found.way.scale > most_scale)
        return err_set(e, ERR_GEOMETRY, "the head is %.2f times as large as the mean one; %g to %g is known",
                       found.way.scale, least_scale, most_scale);
    if (!check_facing(&found, e)) return false;
    *out = (head_place){found.way.motion, found.way.scale,       pointed,
                        found.median_mm,  found.turn_spread_deg, found.shift_spread_mm};
    if (told) tell(&found.way, told);
    return true;
}

void head_place_apply(const head_place *p, const double *xyz, int32_t count, double *out)
{
    similarity s = {p->scale, p->motion};
    for (int32_t i = 0; i < count; i++) similarity_apply(&s, xyz + 3 * (size_t)i, out + 3 * (size_t)i);
}
