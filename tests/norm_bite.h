/* norm_bite: the bite of a synthetic head, measured on its teeth. */
#pragma once
#include "cases/norm_head/norm_head.h"
#include "geometry/nearest.h"
#include <math.h>
#include <stdlib.h>

typedef struct norm_bite {
    bool in_range;     /* overjet and overbite lie in the range of their class */
    int touching[2];   /* left, right: lower teeth behind the canines within 0.1 mm of an upper one */
    double overlap_mm; /* deepest that any of them lies in an upper one */
    double cant_deg;   /* of the steeper of the lines through the upper and lower first molars against the horizontal */
} norm_bite;

/* Within two standard deviations of the mean of the class, or what can be built of that; to 0.1 mm. */
static inline bool norm_bite_in_range(const norm_head *h, const norm_head_params *p, measure_id id)
{
    const measure *m = &measures[id];
    double mean = m->mean[p->sex] + (p->skeletal_class > 1 ? m->class_shift[p->skeletal_class - 2] : 0),
           low = fmax(mean - 2 * m->sd[p->sex], m->low), high = fmin(mean + 2 * m->sd[p->sex], m->high);
    return h->obtained[id] > low - 0.1 && h->obtained[id] < high + 0.1;
}

static inline bool norm_bite_contacts(const norm_head *h, norm_bite *out, err *e)
{
    enum { BEHIND_CANINE = 3 };
    nearest *upper = NULL;
    if (!nearest_create(&h->upper_teeth, &upper, e)) return false;
    int32_t *shell, shells = surface_components(&h->lower_teeth, &shell); /* left side first */
    double *least = malloc((size_t)shells * sizeof *least);
    for (int32_t i = 0; i < shells; i++) least[i] = HUGE_VAL;
    for (int32_t i = 0; i < 3 * h->lower_teeth.triangle_count; i++) {
        const double *p = h->lower_teeth.xyz + 3 * (size_t)h->lower_teeth.tri[i];
        double d = nearest_point(upper, p, NULL, NULL);
        if (d < 1 && nearest_inside(upper, p)) d = -d;
        least[shell[i / 3]] = fmin(least[shell[i / 3]], d);
    }
    for (int32_t i = 0; i < shells; i++) {
        if (i % (shells / 2) < BEHIND_CANINE) continue;
        out->touching[i >= shells / 2] += least[i] < 0.1;
        out->overlap_mm = fmax(out->overlap_mm, -least[i]);
    }
    free(least);
    free(shell);
    nearest_destroy(&upper);
    return true;
}

static inline double norm_bite_cant_deg(const landmarks *l)
{
    static const char *const pair[2][2] = {{"U6_L", "U6_R"}, {"L6_L", "L6_R"}};
    double worst = 0;
    for (int k = 0; k < 2; k++) {
        const double *a = landmarks_find(l, pair[k][0])->xyz, *b = landmarks_find(l, pair[k][1])->xyz;
        double deg = atan2(a[2] - b[2], a[0] - b[0]) * 180 / acos(-1);
        if (fabs(deg) > fabs(worst)) worst = deg;
    }
    return worst;
}

static inline bool norm_bite_measure(const norm_head *h, const norm_head_params *p, norm_bite *out, err *e)
{
    *out = (norm_bite){.in_range = norm_bite_in_range(h, p, OVERJET_MM) && norm_bite_in_range(h, p, OVERBITE_MM),
                       .cant_deg = norm_bite_cant_deg(&h->points)};
    return norm_bite_contacts(h, out, e);
}
