/* What a fit is worth: how far template and scan are apart, seen from both. */
#include "app/planner/identity/fit_state.h"
#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double facing_cos = 0.5;
static const double clear_mm = 16, clear_step_mm = 4;
const double fit_found_mm = 5, fit_missed_mm = 15;

/* Distance to what a surface has across from p, not beside it: beyond fit_found_mm the way there must go along the
 * normal n, or the surface may just end there. HUGE_VAL: it has nothing. */
static double ask_across(const target_surface *t, const double p[3], const double n[3])
{
    static const double along = 0.7;
    const target_rules rules = {fit_missed_mm, facing_cos};
    target_point hit;
    double off[3], d = target_surface_ask(t, p, n, &rules, &hit);
    if (d <= fit_found_mm || d == HUGE_VAL) return d;
    vec_sub(hit.at, p, off);
    return fabs(vec_dot(off, n)) > along * d ? d : HUGE_VAL;
}

static void measure_template(const fit_state *f, case_surface p, head_fit *out)
{
    const surface *s = &f->at[p];
    size_t n = (size_t)s->vertex_count;
    double *gap = NEW_ARRAY(double, n), *normal = surface_vertex_normals(s);
    int32_t count = 0;
    out->gap_mm[p] = NEW_ARRAY(double, n);
    out->guessed[p] = NEW_ARRAY(uint8_t, n);
    for (size_t v = 0; v < n; v++) {
        double d = f->target[p] ? ask_across(f->target[p], s->xyz + 3 * v, normal + 3 * v) : HUGE_VAL;
        bool root = f->buried[p] && f->buried[p][v]; /* in bone: no surface of a scan */
        if (root && d > fit_found_mm) d = HUGE_VAL;
        out->guessed[p][v] = d == HUGE_VAL ? GUESS_ABSENT : d > fit_found_mm ? GUESS_MISSED : GUESS_NONE;
        out->gap_mm[p][v] = d == HUGE_VAL ? (double)NAN : d;
        if (d <= fit_found_mm) gap[count++] = d;
    }
    out->gaps[p] = registration_gaps_of(gap, count, s->vertex_count);
    free(gap);
    free(normal);
}

typedef struct asking {
    const surface *scan;
    const double *normal;
    const distance_tree *own; /* of the scan */
    const target_surface *fitted;
    double *mm; /* [scan->vertex_count] HUGE_VAL: the template does not cover it */
} asking;

/* Nothing of the scan stands before the vertex: a cavity, the far wall of a sinus or an inner table is not on the
 * outside. */
static bool is_outside(const asking *a, size_t v)
{
    double x[3];
    vec_copy(a->scan->xyz + 3 * v, x);
    for (double s = clear_step_mm; s <= clear_mm; s += clear_step_mm) {
        vec_axpy(x, clear_step_mm, a->normal + 3 * v, x);
        if (distance_tree_within(a->own, x, 0.5 * s)) return false;
    }
    return true;
}

static void ask_some(int64_t begin, int64_t end, void *context)
{
    const asking *a = context;
    for (int64_t v = begin; v < end; v++) {
        a->mm[v] = ask_across(a->fitted, a->scan->xyz + 3 * v, a->normal + 3 * v);
        if (a->mm[v] < HUGE_VAL && !is_outside(a, (size_t)v)) a->mm[v] = HUGE_VAL;
    }
}

/* Of the scan's part, which has the crowns too where these are no part of their own. */
static surface counterpart(const fit_state *f, case_surface p)
{
    int teeth = p == CASE_SKULL ? CASE_UPPER_TEETH : p == CASE_MANDIBLE ? CASE_LOWER_TEETH : -1;
    return teeth < 0 || f->target[teeth] ? surface_copy(&f->at[p]) : surface_joined(&f->at[p], &f->at[teeth]);
}

static void measure_scan(const fit_state *f, const surface *scan, case_surface p, head_fit *out)
{
    if (!scan->triangle_count) return;
    surface fitted = counterpart(f, p);
    double *mm = NEW_ARRAY(double, scan->vertex_count), *normal = surface_vertex_normals(scan);
    distance_tree *own = distance_tree_make(scan);
    target_surface *target = target_surface_make(&fitted);
    parallel_for(scan->vertex_count, 256, ask_some, &(asking){scan, normal, own, target, mm});
    int32_t count = 0, missed = 0;
    out->back_mm[p] = NEW_ARRAY(double, scan->vertex_count);
    for (int32_t v = 0; v < scan->vertex_count; v++) {
        out->back_mm[p][v] = mm[v] < HUGE_VAL ? mm[v] : (double)NAN;
        if (mm[v] == HUGE_VAL) continue;
        missed += mm[v] > fit_found_mm;
        mm[count++] = mm[v];
    }
    out->back[p] = registration_gaps_of(mm, count, scan->vertex_count);
    out->back_missed[p] = count ? (double)missed / count : 0;
    target_surface_free(&target);
    distance_tree_free(&own);
    surface_free(&fitted);
    free(normal);
    free(mm);
}

void fit_measure_part(const fit_state *f, const head_scan *s, case_surface p, head_fit *out)
{
    measure_template(f, p, out);
    measure_scan(f, &s->part[p], p, out);
}

void head_fit_measure_tets(const head_template *t, head_fit *f)
{
    f->min_j = head_min_j(t, &f->shape, &f->inverted_tets) / pow(f->place.scale, 3);
}

double fit_shown_mm(const head_fit *f, case_surface part, size_t vertex)
{
    uint8_t why = f->guessed[part][vertex];
    return why == GUESS_ABSENT || why == GUESS_CLOSED ? (double)NAN : f->gap_mm[part][vertex];
}
