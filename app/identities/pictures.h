/* pictures: heads of a model drawn. Needs GNATHOS_RENDER. */
#pragma once
#include "app/identities/identities.h"

/* mean.png, and mode_01.png ... of the first modes: two standard deviations below the mean and above it. */
bool identities_draw(const head_template *t, const head_model *m, const char *folder, err *e) MUST_CHECK;
/* error.png: how far each vertex of the skin lies from where the model puts it; error.ply in the same colours. */
bool identity_draw(const head_template *t, const identities_projection *p, const double *error_mm, const char *folder,
                   err *e) MUST_CHECK;
