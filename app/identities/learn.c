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

bool identities_project(const head_template *t, const head_model *m, const char *case_path, const task *watch,
                        identities_projection *out, err *e)
{
    identities_projection p = {.model = m};
    head_shape s = {0};
    double start = clock_s();
    bool ok = fits_case(t, case_path, watch, &s, p.name, sizeof p.name, e) && head_shape_to_frankfort(t, &s, NULL, e);
    if (ok) {
        p.fit_s = clock_s() - start;
        p.phi = NEW_ARRAY(double, m->modes.length);
        p.made = NEW_ARRAY(double, m->modes.length);
        head_vector_of(t, &s, p.phi);
        principal_project(&m->modes, p.phi, p.p);
        principal_make(&m->modes, p.p, m->modes.mode_count, p.made);
        head_vector_gaps(t, p.phi, p.made, p.gap);
        *out = p;
    }
    head_shape_free(&s);
    return ok;
}

void identities_projection_free(identities_projection *p)
{
    free(p->phi);
    free(p->made);
    *p = (identities_projection){0};
}
