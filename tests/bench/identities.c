/* What 40 numbers lose of a head, apart from what a fit loses: norm heads as the generator makes them, which have one
 * numbering already. Learns from LEARNT of them and makes HELD others from their coefficients.
 *
 *     bench_identities [LEARNT [HELD [COARSENESS]]]      120, 12 and 3 where absent; about 5 s a head on one core */
#include "cases/norm_head/norm_head.h"
#include "geometry/clock.h"
#include "geometry/frame.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/principal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS = 5, MODES = 40 };
static const char *const name[PARTS + 1] = {"skin", "skull", "mandible", "upper teeth", "lower teeth", "face"};

static const surface *part(const norm_head *h, int k)
{
    const surface *const all[PARTS] = {&h->skin, &h->skull, &h->mandible, &h->upper_teeth, &h->lower_teeth};
    return all[k];
}

/* Sexes and classes in turn. In the Frankfort frame. */
static bool head(const norm_mean *mean, int i, int start[PARTS + 1], double **x, norm_head *h, err *e)
{
    norm_head_params p = norm_head_params_default();
    head_frame f;
    p.sex = i % 2 ? NORM_MALE : NORM_FEMALE;
    p.skeletal_class = 1 + i / 2 % 3;
    p.seed = 1000 + (uint64_t)i;
    if (!norm_head_shape(mean, &p, h, e) || !head_frame_from_landmarks(&h->points, &f, e)) return false;
    for (int k = 0; k < PARTS; k++) start[k + 1] = start[k] + 3 * part(h, k)->vertex_count;
    *x = NEW_ARRAY(double, start[PARTS]);
    for (int k = 0; k < PARTS; k++)
        for (int v = 0; v < part(h, k)->vertex_count; v++)
            head_frame_to_local(&f, part(h, k)->xyz + 3 * v, *x + start[k] + 3 * v);
    return true;
}

/* The area around each vertex as a share of its part. */
static void weigh(const surface *s, double *w)
{
    double all = surface_area(s);
    for (int i = 0; i < s->triangle_count; i++) {
        const int32_t *v = s->tri + 3 * i;
        double ab[3], ac[3], n[3];
        vec_sub(s->xyz + 3 * v[1], s->xyz + 3 * v[0], ab);
        vec_sub(s->xyz + 3 * v[2], s->xyz + 3 * v[0], ac);
        vec_cross(ab, ac, n);
        for (int k = 0; k < 9; k++) w[3 * v[k / 3] + k % 3] += vec_norm(n) / 6 / all;
    }
}

/* In front of the porions, between 40 mm above and 130 mm below them. */
static bool in_face(const double p[3]) { return p[1] < -10 && p[2] > -130 && p[2] < 40; }

static void compare(const principal *m, double *const *x, int from, int to, const int start[PARTS + 1])
{
    double sum[PARTS + 1] = {0}, count[PARTS + 1] = {0}, most[PARTS + 1] = {0}, p[MODES],
                       *made = NEW_ARRAY(double, m->length);
    for (int s = from; s < to; s++) {
        principal_project(m, x[s], p);
        principal_make(m, p, m->mode_count, made);
        for (int k = 0; k < PARTS; k++)
            for (int i = start[k]; i < start[k + 1]; i += 3) {
                double d = vec_distance(x[s] + i, made + i);
                int last = k == 0 && in_face(x[s] + i) ? PARTS : k;
                for (int g = k; g <= last; g += PARTS) sum[g] += d, count[g]++, most[g] = fmax(most[g], d);
            }
    }
    printf("%-12s %9s %9s   of %d heads that were held out, mm\n", "", "mean", "largest", to - from);
    for (int g = 0; g <= PARTS; g++) printf("%-12s %9.3f %9.2f\n", name[g], sum[g] / count[g], most[g]);
    free(made);
}

int main(int argc, char **argv)
{
    int learnt = argc > 1 ? atoi(argv[1]) : 120, held = argc > 2 ? atoi(argv[2]) : 12, start[PARTS + 1] = {0};
    err e = {0};
    norm_mean *mean = NULL;
    principal m = {0};
    double **x = NEW_ARRAY(double *, learnt + held), *w = NULL, begin = clock_s();
    bool ok = norm_mean_build(argc > 3 ? atof(argv[3]) : 3, false, &mean, &e);
    for (int i = 0; ok && i < learnt + held; i++) {
        norm_head h = {0};
        ok = head(mean, i, start, &x[i], &h, &e);
        if (ok && !w) {
            w = NEW_ARRAY(double, start[PARTS]);
            for (int k = 0; k < PARTS; k++) weigh(part(&h, k), w + start[k]);
        }
        norm_head_free(&h);
    }
    double made_s = clock_s() - begin;
    ok = ok && principal_learn((const double *const *)x, learnt, start[PARTS], w, MODES, &m, &e);
    if (ok) {
        double share = 0;
        for (int k = 0; k < m.mode_count; k++) share += principal_share(&m, k);
        printf("%d heads of %d vertices in %.0f s; %d modes in %.1f s have %.2f %% of the variance\n", learnt + held,
               start[PARTS] / 3, made_s, m.mode_count, clock_s() - begin - made_s, 100 * share);
        compare(&m, x, learnt, learnt + held, start);
    } else {
        fprintf(stderr, "%s\n", e.text);
    }
    principal_free(&m);
    for (int i = 0; i < learnt + held; i++) free(x[i]);
    free(x);
    free(w);
    norm_mean_free(mean);
    return (int)e.code;
}
