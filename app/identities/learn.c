#include "app/identities/fits.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

bool identities_learn_write(const head_template *t, const identities_learn *p, const char *path, const task *watch,
                            identities_learnt *out, err *e)
{
    char journal[FIELD_PATH_SIZE + 16];
    struct stat file;
    fits_source from;
    head_set set = {0};
    identities_learnt l = {0};
    snprintf(journal, sizeof journal, "%s.journal", path);
    if (!fits_source_open(t, p, watch, &from, e)) return false;
    bool ok = head_gather(t, &from.source, from.key, journal, p->anew, watch, &set, e);
    double start = clock_s();
    ok = ok && head_model_learn(t, (const double *const *)set.phi, set.name, set.count, watch, &l.model, e) &&
         head_model_write(&l.model, path, e);
    if (ok) {
        unlink(journal); /* the work is done */
        l.learn_s = clock_s() - start;
        l.fit_s = set.seconds;
        l.fresh = set.fresh;
        l.refused = set.refused;
        if (!stat(path, &file)) l.bytes = file.st_size;
        *out = l;
    } else {
        head_model_free(&l.model);
    }
    head_set_free(&set);
    fits_source_free(&from);
    return ok;
}

/* What a fit reaches of a good scan. */
static const double noise_mm = 0.5;

/* 0 where the fit guessed; of the tissue, which the scan does not show, all counts. */
static double *known_of(const head_template *t, const head_fit *f)
{
    head_layout l = head_layout_of(t);
    double *known = NEW_ARRAY(double, l.start[HEAD_BLOCK_COUNT]);
    for (int b = 0; b < HEAD_BLOCK_COUNT; b++) {
        int part = head_block_surface((head_block)b);
        for (int32_t i = l.start[b]; i < l.start[b + 1]; i++)
            known[i] = part < 0 || !f->guessed[part][(i - l.start[b]) / 3];
    }
    return known;
}

static bool project(const head_template *t, const head_fit *f, identities_projection *p, err *e)
{
    const principal *modes = &p->model->modes;
    p->guessed = fits_guessed(t, f, CASE_SKIN);
    p->known = known_of(t, f);
    p->phi = NEW_ARRAY(double, modes->length);
    p->made = NEW_ARRAY(double, modes->length);
    head_vector_of(t, &f->shape, p->phi);
    bool whole = true;
    for (int32_t i = 0; whole && i < modes->length; i++) whole = p->known[i] > 0;
    if (whole)
        principal_project(modes, p->phi, p->p);
    else if (!principal_complete(modes, p->phi, p->known, noise_mm, p->p, e))
        return false;
    principal_make(modes, p->p, modes->mode_count, p->made);
    head_vector_gaps(t, p->phi, p->made, p->known, p->gap);
    return true;
}

bool identities_project(const head_template *t, const head_model *m, const char *path, const task *watch,
                        identities_projection *out, err *e)
{
    identities_projection p = {.model = m};
    head_fit f = {0};
    double start = clock_s();
    bool ok = fits_case(t, path, watch, &f, p.name, sizeof p.name, e) && head_shape_to_frankfort(t, &f.shape, NULL, e);
    p.fit_s = clock_s() - start;
    ok = ok && project(t, &f, &p, e);
    head_fit_free(&f);
    if (ok)
        *out = p;
    else
        identities_projection_free(&p);
    return ok;
}

void identities_projection_free(identities_projection *p)
{
    free(p->phi);
    free(p->made);
    free(p->known);
    *p = (identities_projection){0};
}
