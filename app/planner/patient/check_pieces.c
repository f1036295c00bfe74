/* One surface by itself: a part that its file holds twice, or of several people; stairs of thick slices. */
#include "app/planner/patient/check_parts.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

typedef struct piece { /* triangles that hang together */
    double low[3], high[3], six_volumes;
} piece;

static double size(const piece *p) { return vec_distance(p->low, p->high); }

static piece *pieces_of(const surface *s, int32_t *count)
{
    int32_t *of;
    *count = surface_components(s, &of);
    piece *out = NEW_ARRAY(piece, *count);
    for (int32_t i = 0; i < *count; i++) {
        out[i] = (piece){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0};
    }
    for (int32_t t = 0; t < s->triangle_count; t++) {
        piece *p = &out[of[t]];
        const int32_t *v = s->tri + 3 * (size_t)t;
        const double *first = s->xyz; /* any fixed point does where pieces are closed, and nearly so where not */
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++) {
                double x = s->xyz[3 * (size_t)v[k] + (size_t)c];
                p->low[c] = fmin(p->low[c], x);
                p->high[c] = fmax(p->high[c], x);
            }
        p->six_volumes +=
            vec_six_volume(first, s->xyz + 3 * (size_t)v[0], s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[2]);
    }
    free(of);
    return out;
}

/* Share of both boxes that they have in common. */
static double common_share(const piece *a, const piece *b)
{
    double common = 1, one = 1, other = 1;
    for (int c = 0; c < 3; c++) {
        common *= fmax(0, fmin(a->high[c], b->high[c]) - fmax(a->low[c], b->low[c]));
        one *= a->high[c] - a->low[c];
        other *= b->high[c] - b->low[c];
    }
    return one + other > common ? common / (one + other - common) : 0;
}

void check_pieces(const surface *s, const char *file, case_surface part, issue_list *issues)
{
    const double alike = 0.7, one_place = 0.5;
    int32_t count, largest = 0;
    piece *p = pieces_of(s, &count);
    for (int32_t i = 1; i < count; i++)
        if (size(&p[i]) > size(&p[largest])) largest = i;
    for (int32_t i = 0; i < count; i++) {
        double low[3], high[3];
        if (i == largest || size(&p[i]) < alike * size(&p[largest])) continue;
        if (p[i].six_volumes * p[largest].six_volumes <= 0) continue; /* the inner wall of a shell */
        vec_add(p[largest].low, p[largest].high, low);
        vec_add(p[i].low, p[i].high, high);
        double apart_mm = vec_distance(low, high) / 2;
        bool twice = common_share(&p[i], &p[largest]) > one_place;
        if (!twice && part != CASE_SKIN && part != CASE_SKULL) continue; /* the halves of a jaw */
        issue_add(issues, ISSUE_WARNING, ERR_NONE, file, 0, NULL,
                  twice
                      ? "holds the %s twice: pieces of %.0f and %.0f mm corner to corner, their middles %.1f mm apart, "
                        "before and after perhaps; keep one"
                      : "holds the %s of 2 heads: pieces of %.0f and %.0f mm corner to corner, their middles %.0f mm "
                        "apart; keep one",
                  case_surface_name(part), size(&p[largest]), size(&p[i]), apart_mm);
        break;
    }
    free(p);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How strictly corners keep to planes that lie `slice` apart, 0 to 1. */
static double keeping(const surface *s, int axis, double slice)
{
    enum { SAMPLES = 500 };
    int count = s->vertex_count < SAMPLES ? s->vertex_count : SAMPLES;
    double re = 0, im = 0;
    for (int k = 0; k < count; k++) {
        double phase = 2 * M_PI / slice * s->xyz[3 * ((int64_t)k * s->vertex_count / count) + axis];
        re += cos(phase) / count;
        im += sin(phase) / count;
    }
    return hypot(re, im);
}

/* Surfaces that were taken from thick slices as they are stand on the slices' planes. A single plane, where a scan was
 * cut off, is kept to at every thickness, so that the usual one is taken off. */
void check_slices(const surface *s, const char *file, case_surface part, issue_list *issues)
{
    enum { STEPS = 170 };
    const double thin_mm = 2.4, step = 1.006, most = 0.4;
    for (int axis = 0; axis < 3; axis++) {
        double kept[STEPS], sorted[STEPS], slice_mm = thin_mm;
        int best = 0;
        for (int i = 0; i < STEPS; i++, slice_mm *= step) {
            sorted[i] = kept[i] = keeping(s, axis, slice_mm);
            if (kept[i] > 0.95 * kept[best]) best = i; /* of 5 mm and its half the 5 mm */
        }
        qsort(sorted, STEPS, sizeof *sorted, by_value);
        if (kept[best] - sorted[STEPS / 2] < most) continue;
        issue_add(
            issues, ISSUE_WARNING, ERR_NONE, file, 0, NULL,
            "the %s stands on planes %.1f mm apart along %c, the slices of a scan: between them it is known to no "
            "better than that; up to 2 mm would be right, or smooth it",
            case_surface_name(part), thin_mm * pow(step, best), 'x' + axis);
    }
}
