/* fits: where the heads of a model come from. */
#pragma once
#include "app/identities/identities.h"
#include "app/planner/identity/head_fit.h"
#include "cases/norm_head/norm_head.h"

/* The template on the head of a case, in its frame; where `path` is a folder of gnathos fit, the fit that it holds. The
 * caller frees *out. */
bool fits_case(const head_template *t, const char *path, const task *watch, head_fit *out, char *name, size_t name_size,
               err *e) MUST_CHECK;
/* Share of the vertices of a part that the fit guessed. */
double fits_guessed(const head_template *t, const head_fit *f, case_surface part);

typedef struct fits_source { /* not to be moved in memory */
    head_source source;
    char key[HASH_TEXT_SIZE];
    const head_template *t;
    const identities_learn *p;
    const task *watch;
    norm_mean *mean;
    char (*name)[HEAD_NAME_SIZE];
    const char **names;
} fits_source;

/* Reads what the cases name into the key and meshes the mean norm head. Refuses cases that cannot be read and one that
 * is named twice. Free with fits_source_free. */
bool fits_source_open(const head_template *t, const identities_learn *p, const task *watch, fits_source *out,
                      err *e) MUST_CHECK;
void fits_source_free(fits_source *s);
