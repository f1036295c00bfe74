#include "app/planner/identity/head_fit.h"
#include "app/planner/identity/fit_state.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

head_fit_params head_fit_params_default(void) { return (head_fit_params){.use_landmarks = true}; }

void head_fit_free(head_fit *f)
{
    head_shape_free(&f->shape);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        free(f->gap_mm[p]);
        free(f->guessed[p]);
        free(f->back_mm[p]);
    }
    *f = (head_fit){0};
}

fit_state fit_begin(const head_template *t, const head_scan *s, const head_fit_params *params, const task *watch,
                    const head_place *place)
{
    fit_state f = {.t = t, .params = params, .watch = watch, .cost = {.min_j = HUGE_VAL}};
    size_t n = 3 * (size_t)t->tissue.mesh.vertex_count;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        if (s->part[p].triangle_count) f.target[p] = target_surface_make(&s->part[p]);
        if (params->from) {
            f.placed[p] = head_part(t, params->from, (case_surface)p);
        } else {
            f.placed[p] = surface_copy(&t->part[p]);
            head_place_apply(place, t->part[p].xyz, t->part[p].vertex_count, f.placed[p].xyz);
        }
        f.at[p] = surface_copy(&f.placed[p]);
    }
    f.buried[CASE_UPPER_TEETH] = fit_buried(&t->part[CASE_UPPER_TEETH], &t->part[CASE_SKULL]);
    f.buried[CASE_LOWER_TEETH] = fit_buried(&t->part[CASE_LOWER_TEETH], &t->part[CASE_MANDIBLE]);
    f.placed_nodes = NEW_ARRAY(double, n);
    if (params->from)
        memcpy(f.placed_nodes, params->from->neutral, n * sizeof *f.placed_nodes);
    else
        head_place_apply(place, t->tissue.mesh.xyz, t->tissue.mesh.vertex_count, f.placed_nodes);
    f.nodes = COPY_ARRAY(double, f.placed_nodes, n);
    return f;
}

void fit_end(fit_state *f)
{
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        target_surface_free(&f->target[p]);
        surface_free(&f->at[p]);
        surface_free(&f->placed[p]);
        free(f->buried[p]);
    }
    free(f->nodes);
    free(f->placed_nodes);
}

bool fit_keep(const fit_state *f, head_fit *out, err *e)
{
    size_t n = 3 * (size_t)f->t->tissue.mesh.vertex_count;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        out->shape.part[p] = COPY_ARRAY(double, f->at[p].xyz, 3 * (size_t)f->at[p].vertex_count);
    out->shape.neutral = COPY_ARRAY(double, f->nodes, n);
    out->shape.rest = NEW_ARRAY(double, n);
    fit_rest(f->t, f->nodes, out->shape.rest);
    head_fit_measure_tets(f->t, out);
    out->iterations = f->cost.iterations;
    out->factorisations = f->cost.factorisations;
    return !out->inverted_tets ||
           err_set(e, ERR_NOT_CONVERGED, "the fit turns %d tets of the tissue inside out", out->inverted_tets);
}

bool head_fit_from(const head_template *t, const head_scan *s, const head_fit_params *p, const head_place *place,
                   const task *watch, head_fit *out, err *e)
{
    double start = clock_s();
    head_fit fit = {.place = *place};
    fit_state f = fit_begin(t, s, p, watch, place);
    task_progress(watch, "bending the whole", 0.1);
    bool ok = fit_bend(&f, e);
    task_progress(watch, "bones and teeth", 0.4);
    ok = ok && fit_bones(&f, e);
    fit.bones_s = clock_s() - start;
    task_progress(watch, "tissue", 0.6);
    ok = ok && fit_tissue(&f, e);
    task_progress(watch, "skin", 0.8);
    ok = ok && fit_skin(&f, e);
    if (ok) {
        fit.total_s = clock_s() - start;
        fit.tissue_s = fit.total_s - fit.bones_s;
        for (int part = 0; part < CASE_SURFACE_COUNT; part++) fit_measure_part(&f, s, (case_surface)part, &fit);
        ok = fit_keep(&f, &fit, e);
    }
    fit_end(&f);
    if (ok)
        *out = fit;
    else
        head_fit_free(&fit);
    return ok;
}

bool head_fit_make(const head_template *t, const head_scan *s, const head_fit_params *p, const task *watch,
                   head_fit *out, err *e)
{
    head_place place;
    head_scan bare = *s;
    double begin = clock_s();
    if (!p->use_landmarks) bare.points = (landmarks){0};
    task_progress(watch, "place", 0);
    if (!head_place_find(t, &bare, watch, &place, NULL, e)) return false;
    double placed = clock_s() - begin;
    if (!head_fit_from(t, s, p, &place, watch, out, e)) return false;
    out->place_s = placed;
    out->total_s += placed;
    return true;
}
