#include "app/planner/identity/head_complete.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

/* Skin that went farther than this with a mouth that was closed is not where the scan has it. */
static const double moved_mm = 0.5;
static bool fit_and_close(const head_template *t, const head_scan *s, const head_shape *from, const head_place *place,
                          const task *watch, head_fit *out, head_closing *jaw, err *e)
{
    head_fit_params params = head_fit_params_default();
    params.from = from;
    if (!head_fit_from(t, s, &params, place, watch, out, e)) return false;
    size_t n = (size_t)t->part[CASE_SKIN].vertex_count;
    double *before = COPY_ARRAY(double, out->shape.part[CASE_SKIN], 3 * n);
    bool ok = head_jaw_close(t, place, watch, &out->shape, jaw, e);
    for (size_t v = 0; ok && v < n; v++)
        if (!out->guessed[CASE_SKIN][v] && vec_distance(before + 3 * v, out->shape.part[CASE_SKIN] + 3 * v) > moved_mm)
            out->guessed[CASE_SKIN][v] = GUESS_CLOSED;
    free(before);
    if (ok)
        head_fit_measure_tets(t, out);
    else
        head_fit_free(out);
    return ok;
}

bool head_complete(const head_template *t, const head_scan *s, const head_model *m, const head_place *place,
                   const task *watch, head_fit *out, head_completion *how, err *e)
{
    double start = clock_s();
    head_fit first;
    head_shape likely;
    *how = (head_completion){0};
    if (!fit_and_close(t, s, NULL, place, watch, &first, &how->jaw, e)) return false;
    if (!m) {
        *out = first;
    } else {
        task_progress(watch, "the likeliest head", -1);
        bool ok = head_likeliest_make(t, m, &first, &how->likeliest, &likely, e);
        head_fit_free(&first);
        if (!ok) return false;
        ok = fit_and_close(t, s, &likely, place, watch, out, &how->jaw, e);
        head_shape_free(&likely);
        if (!ok) return false;
    }
    out->total_s = clock_s() - start;
    return true;
}
