/* Errors, orders, and who is on the front. */
#include "app/study/study.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

void study_run_free(study_run *r)
{
    free(r->skin_mm);
    free(r->point_mm);
    *r = (study_run){0};
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

study_error study_compare(const study_run *a, const study_run *b)
{
    const double moved_mm = 0.1;
    double unknown = (double)NAN;
    study_error r = {unknown, unknown, unknown, 0};
    if (!a->skin_mm || !b->skin_mm || a->skin_count != b->skin_count) return r;
    double *off = NEW_ARRAY(double, a->skin_count), sum = 0;
    for (int32_t v = 0; v < a->skin_count; v++) {
        if (!(vec_norm(b->skin_mm + 3 * (size_t)v) > moved_mm)) continue;
        off[r.vertices] = vec_distance(a->skin_mm + 3 * (size_t)v, b->skin_mm + 3 * (size_t)v);
        sum += off[r.vertices++];
    }
    if (r.vertices) {
        qsort(off, (size_t)r.vertices, sizeof *off, by_value);
        r.mean_mm = sum / r.vertices;
        r.p95_mm = off[(size_t)(0.95 * (r.vertices - 1))];
        r.max_mm = off[r.vertices - 1];
    }
    free(off);
    return r;
}

double study_order(const double d[2])
{
    double p = log2(d[0] / d[1] - 1);
    return p > 0.2 ? p : (double)NAN;
}

double study_slope(const double *h, const double *error, int count)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < count; i++) {
        if (!(error[i] > 0)) continue;
        double a = log(h[i]), b = log(error[i]);
        n++;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return n < 2 ? (double)NAN : (n * xy - x * y) / (n * xx - x * x);
}

/* Rungs that differ in the mesh alone can be compared with the reference; other models are other questions.
 */
static bool counts(const study_table *t, int i)
{
    return t->run[i].result.solved && i != study_reference && study_rungs[i].group != GROUP_MATERIAL &&
           study_rungs[i].group != GROUP_THREADS && !study_rungs[i].contact && t->error[i].mean_mm > 0;
}

static double slope_of(const study_table *t, element_kind element)
{
    double *h = NEW_ARRAY(double, t->count), *d = NEW_ARRAY(double, t->count);
    int n = 0;
    for (int i = 0; i < t->count; i++) {
        if (!counts(t, i) || study_rungs[i].group > GROUP_ELEMENT || study_rungs[i].element != (int)element ||
            study_rungs[i].refined)
            continue;
        h[n] = t->run[i].result.size_mm;
        d[n++] = t->error[i].mean_mm;
    }
    double slope = study_slope(h, d, n);
    free(h);
    free(d);
    return slope;
}

void study_table_make(study_table *t)
{
    const study_run *reference = &t->run[study_reference];
    t->error = NEW_ARRAY(study_error, t->count);
    t->best = NEW_ARRAY(bool, t->count);
    t->change = NEW_ARRAY(study_error, t->count);
    for (int i = 0; i < t->count; i++) {
        const study_run none = {0};
        bool own = study_rungs[i].coarsening == 1 && study_rungs[i].refined == 0;
        t->error[i] = study_compare(&t->run[i], reference);
        t->change[i] = study_compare(own ? &t->run[i] : &none, &t->run[study_default]);
    }
    for (int i = 0; i < t->count; i++) {
        t->best[i] = counts(t, i);
        for (int k = 0; t->best[i] && k < t->count; k++)
            if (counts(t, k) && t->run[k].result.wall_s < t->run[i].result.wall_s &&
                t->error[k].mean_mm <= t->error[i].mean_mm)
                t->best[i] = false;
    }
    double d[2], step = t->error[study_default].mean_mm;
    for (int k = 0; k < 2; k++) d[k] = study_compare(&t->run[study_family[k]], &t->run[study_family[2]]).mean_mm;
    t->order = study_order(d);
    t->reference_error_mm = isnan(t->order) ? step : step / (exp2(t->order) - 1);
    t->plain_slope = slope_of(t, ELEMENT_AUTO);
    t->average_slope = slope_of(t, ELEMENT_AVERAGED);
}

void study_table_free(study_table *t)
{
    for (int i = 0; i < t->count; i++) study_run_free(&t->run[i]);
    free(t->run);
    free(t->error);
    free(t->change);
    free(t->best);
    *t = (study_table){0};
}

int study_soonest(const study_table *t, double limit_mm, bool p95, double own_mm)
{
    int best = -1;
    for (int i = 0; i < t->count; i++) {
        double error = (p95 ? t->error[i].p95_mm : t->error[i].mean_mm) + own_mm;
        if (!counts(t, i) || !(error <= limit_mm)) continue;
        if (best < 0 || t->run[i].result.wall_s < t->run[best].result.wall_s) best = i;
    }
    return best;
}
