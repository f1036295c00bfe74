/* Heads in the template's own numbering: where each vertex is needs no search, and a sought one would be off by what a
 * surface can slide along another. */
#include "app/planner/identity/fit_state.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include <string.h>

bool head_fit_is_numbered(const head_template *t, const head_scan *s)
{
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        const surface *own = &t->part[p], *part = &s->part[p];
        if (part->vertex_count != own->vertex_count || part->triangle_count != own->triangle_count ||
            memcmp(part->tri, own->tri, 3 * (size_t)own->triangle_count * sizeof *own->tri) != 0)
            return false;
    }
    return true;
}

/* The template as a whole on the scan, by all its vertices. */
static head_place place_of(const head_template *t, const head_scan *s)
{
    int32_t count = 0;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) count += t->part[p].vertex_count;
    double *from = NEW_ARRAY(double, 3 * (size_t)count), *to = NEW_ARRAY(double, 3 * (size_t)count);
    for (size_t p = 0, at = 0; p < CASE_SURFACE_COUNT; at += 3 * (size_t)t->part[p++].vertex_count) {
        size_t bytes = 3 * (size_t)t->part[p].vertex_count * sizeof *from;
        memcpy(from + at, t->part[p].xyz, bytes);
        memcpy(to + at, s->part[p].xyz, bytes);
    }
    similarity way;
    similarity_of_pairs(from, to, NULL, count, true, &way);
    free(from);
    free(to);
    return (head_place){.motion = way.motion, .scale = way.scale};
}

bool head_fit_numbered(const head_template *t, const head_scan *s, const task *watch, head_fit *out, err *e)
{
    static const head_scan no_targets = {0};
    double start = clock_s();
    if (!head_fit_is_numbered(t, s)) return err_set(e, ERR_INPUT, "the head has not the numbering of the template");
    head_fit_params how = head_fit_params_default();
    head_fit fit = {.place = place_of(t, s)};
    fit_state f = fit_begin(t, &no_targets, &how, watch, &fit.place);
    f.known = true;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        int32_t n = f.at[p].vertex_count;
        memcpy(f.at[p].xyz, s->part[p].xyz, 3 * (size_t)n * sizeof *f.at[p].xyz);
        fit.guessed[p] = NEW_ARRAY(uint8_t, n);
        fit.gap_mm[p] = NEW_ARRAY(double, n);
        fit.gaps[p] = fit.back[p] = (registration_gaps){.vertices = n, .with_target = n};
    }
    task_progress(watch, "tissue", -1);
    bool ok = fit_tissue(&f, e) && fit_keep(&f, &fit, e);
    if (ok) fit.total_s = fit.tissue_s = clock_s() - start;
    fit_end(&f);
    if (ok)
        *out = fit;
    else
        head_fit_free(&fit);
    return ok;
}
