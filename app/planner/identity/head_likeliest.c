#include "app/planner/identity/head_likeliest.h"
#include "app/planner/identity/head_sound.h"
#include "geometry/mem.h"
#include "geometry/similarity.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A real head lies about so far off what 40 modes of other heads can be, all of a patch so wide one way. */
static const double off_mm = 1.5, patch_mm = 30;
enum { ROUNDS = 6, TRIES = 5 };

/* 1 where the scan has a surface; the tissue follows from those. */
static double *known_of(const head_template *t, const head_fit *f)
{
    head_layout l = head_layout_of(t);
    double *known = NEW_ARRAY(double, l.start[HEAD_BLOCK_COUNT]);
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++) {
        int part = head_block_surface((head_block)b);
        for (int32_t i = l.start[b]; part >= 0 && i < l.start[b + 1]; i++)
            known[i] = !f->guessed[part][(i - l.start[b]) / 3];
    }
    return known;
}

/* What a coordinate of its own would have to be off for all to say as little as patches do that are off as one. */
static double noise_of(const head_template *t, const principal *m)
{
    double mm2 = 0;
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) mm2 += surface_area(&t->part[p]);
    return off_mm * sqrt(m->length * patch_mm * patch_mm / (3 * mm2));
}

/* made[length]: the model's likeliest head in the frame of phi, laid on what is known of it and found anew in turn. */
static bool likeliest(const principal *m, const double *phi, const double *known, double noise, double *p, double *made,
                      err *e)
{
    int32_t points = m->length / 3;
    double *weight = NEW_ARRAY(double, points), *in_model = NEW_ARRAY(double, m->length);
    similarity way;
    for (int32_t i = 0; i < points; i++) weight[i] = known[3 * i] * m->weight[3 * i];
    memcpy(made, m->mean, (size_t)m->length * sizeof *made);
    bool ok = true;
    for (int round = 0; ok && round <= ROUNDS; round++) {
        similarity_of_pairs(made, phi, weight, points, false, &way);
        if (round == ROUNDS) break;
        similarity back = similarity_inverse(&way);
        for (size_t i = 0; i < (size_t)points; i++) similarity_apply(&back, phi + 3 * i, in_model + 3 * i);
        ok = principal_complete(m, in_model, known, noise, p, e);
        if (ok) principal_make(m, p, m->mode_count, made);
    }
    for (size_t i = 0; ok && i < (size_t)points; i++) similarity_apply(&way, made + 3 * i, made + 3 * i);
    free(weight);
    free(in_model);
    return ok;
}

bool head_likeliest_make(const head_template *t, const head_model *m, const head_fit *f, head_likeliest *how,
                         head_shape *out, err *e)
{
    head_soundness own, found;
    head_shape shape = head_shape_of(t);
    bool ok = head_soundness_of(t, &shape, &own, e), sound = false;
    head_shape_free(&shape);
    double *phi = NEW_ARRAY(double, m->modes.length), *made = NEW_ARRAY(double, m->modes.length),
           *known = known_of(t, f);
    err why = {0};
    head_vector_of(t, &f->shape, phi);
    how->mode_count = m->modes.mode_count;
    how->noise_mm = noise_of(t, &m->modes);
    for (int k = 0; ok && !sound && k < TRIES; k++) {
        if (k) how->noise_mm *= 2;
        ok = likeliest(&m->modes, phi, known, how->noise_mm, how->p, made, e);
        if (!ok) break;
        shape = head_vector_shape(t, made);
        ok = head_soundness_of(t, &shape, &found, e);
        why = (err){0};
        sound = ok && head_sound(&found, own.teeth_overlap_mm, &why);
        if (sound)
            *out = shape;
        else
            head_shape_free(&shape);
    }
    if (ok && !sound) ok = err_set(e, ERR_GEOMETRY, "the model's likeliest head of this scan is none: %s", why.text);
    free(phi);
    free(made);
    free(known);
    return ok;
}
