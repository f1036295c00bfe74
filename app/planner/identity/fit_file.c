#include "app/planner/identity/fit_file.h"
#include "app/planner/patient/pack_arrays.h"
#include "app/planner/patient/prepared_sound.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PLACE_NUMBERS = 17,
    GAP_NUMBERS = 11,
    COST_NUMBERS = 8,
    NUMBERS = PLACE_NUMBERS + GAP_NUMBERS * CASE_SURFACE_COUNT + COST_NUMBERS
};

/* One order for both ways: number by number into x, or out of it. */
typedef struct tape {
    double *x;
    int at;
    bool out;
} tape;

static double roll(tape *t, double value)
{
    if (t->out) return t->x[t->at++];
    return t->x[t->at++] = value;
}

static void roll_gaps(tape *t, registration_gaps *g)
{
    g->vertices = (int32_t)roll(t, g->vertices);
    g->with_target = (int32_t)roll(t, g->with_target);
    g->mean_mm = roll(t, g->mean_mm);
    g->p95_mm = roll(t, g->p95_mm);
    g->max_mm = roll(t, g->max_mm);
}

static void roll_fit(tape *t, head_fit *f)
{
    for (int i = 0; i < 9; i++) f->place.motion.r[i] = roll(t, f->place.motion.r[i]);
    for (int i = 0; i < 3; i++) f->place.motion.t[i] = roll(t, f->place.motion.t[i]);
    f->place.scale = roll(t, f->place.scale);
    f->place.by_landmarks = roll(t, f->place.by_landmarks) != 0;
    f->place.median_mm = roll(t, f->place.median_mm);
    f->place.turn_spread_deg = roll(t, f->place.turn_spread_deg);
    f->place.shift_spread_mm = roll(t, f->place.shift_spread_mm);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        roll_gaps(t, &f->gaps[p]);
        roll_gaps(t, &f->back[p]);
        f->back_missed[p] = roll(t, f->back_missed[p]);
    }
    f->min_j = roll(t, f->min_j);
    f->inverted_tets = (int32_t)roll(t, f->inverted_tets);
    f->iterations = (int)roll(t, f->iterations);
    f->factorisations = (int)roll(t, f->factorisations);
    f->place_s = roll(t, f->place_s);
    f->bones_s = roll(t, f->bones_s);
    f->tissue_s = roll(t, f->tissue_s);
    f->total_s = roll(t, f->total_s);
}

static void key_of(int part, const char *what, char key[PACK_NAME_SIZE])
{
    snprintf(key, PACK_NAME_SIZE, "%s.%s", case_surface_name((case_surface)part), what);
}

bool head_fit_write(const head_template *t, const head_fit *f, const char *path, err *e)
{
    pack_file file = {0};
    char key[PACK_NAME_SIZE];
    double numbers[NUMBERS];
    size_t nodes = 3 * (size_t)t->tissue.mesh.vertex_count * sizeof(double);
    head_fit copy = *f;
    pack_put(&file, "numbering", t->numbering, sizeof t->numbering);
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) {
        size_t n = (size_t)t->part[p].vertex_count;
        key_of(p, "xyz", key);
        pack_put(&file, key, f->shape.part[p], 3 * n * sizeof(double));
        key_of(p, "gap", key);
        pack_put(&file, key, f->gap_mm[p], n * sizeof(double));
        key_of(p, "guessed", key);
        pack_put(&file, key, f->guessed[p], n);
    }
    pack_put(&file, "node.rest", f->shape.rest, nodes);
    pack_put(&file, "node.neutral", f->shape.neutral, nodes);
    roll_fit(&(tape){numbers, 0, false}, &copy);
    pack_put(&file, "numbers", numbers, sizeof numbers);
    bool ok = pack_write(&file, path, e);
    pack_free(&file);
    return ok;
}

/* As many as wanted, or NULL. */
static void *take(const pack_file *f, const char *name, size_t element, int64_t wanted)
{
    int32_t count = 0;
    void *array = pack_take_array(f, name, element, &count);
    if (count == wanted) return array;
    free(array);
    return NULL;
}

static bool take_points(const pack_file *f, const char *name, int32_t count, double **xyz)
{
    *xyz = take(f, name, 3 * sizeof **xyz, count);
    return *xyz && all_finite(*xyz, 3 * (int64_t)count);
}

static bool take_fit(const pack_file *f, const head_template *t, head_fit *out)
{
    char key[PACK_NAME_SIZE];
    double *numbers = take(f, "numbers", sizeof *numbers, NUMBERS);
    if (!numbers) return false;
    bool sound = all_finite(numbers, NUMBERS);
    for (int i = 0; i < NUMBERS; i++) sound = sound && fabs(numbers[i]) < INT32_MAX;
    if (sound) roll_fit(&(tape){numbers, 0, true}, out);
    free(numbers);
    for (int p = 0; sound && p < CASE_SURFACE_COUNT; p++) {
        int32_t n = t->part[p].vertex_count;
        key_of(p, "xyz", key);
        sound = take_points(f, key, n, &out->shape.part[p]);
        key_of(p, "gap", key);
        out->gap_mm[p] = take(f, key, sizeof *out->gap_mm[p], n);
        key_of(p, "guessed", key);
        out->guessed[p] = take(f, key, 1, n);
        sound = sound && out->gap_mm[p] && out->guessed[p];
    }
    return sound && take_points(f, "node.rest", t->tissue.mesh.vertex_count, &out->shape.rest) &&
           take_points(f, "node.neutral", t->tissue.mesh.vertex_count, &out->shape.neutral);
}

bool head_fit_read(const head_template *t, const char *path, head_fit *out, err *e)
{
    pack_file f = {0};
    err unreadable = {0};
    if (!pack_read(path, &f, &unreadable))
        return err_at(e, ERR_INPUT, path, 0, NULL, "is no whole fit (fit.pack of gnathos fit)");
    head_fit fit = {0};
    char *numbering = pack_text(&f, "numbering");
    bool ok = false;
    if (!numbering)
        err_at(e, ERR_INPUT, path, 0, NULL, "is no fit (fit.pack of gnathos fit)");
    else if (strcmp(numbering, t->numbering) != 0)
        err_at(e, ERR_INPUT, path, 0, NULL, "is the fit of a template with another numbering; run gnathos fit again");
    else if (!take_fit(&f, t, &fit))
        err_at(e, ERR_INPUT, path, 0, NULL, "is a damaged fit");
    else
        ok = true;
    free(numbering);
    pack_free(&f);
    if (ok)
        *out = fit;
    else
        head_fit_free(&fit);
    return ok;
}
