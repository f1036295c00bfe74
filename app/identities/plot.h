/* plot: the variance of the modes, and the error of heads left out, as a picture. */
#pragma once
#include "app/planner/identity/head_model.h"

/* folder/variance.png. Refuses (ERR_RESOURCE) what cannot be drawn or written. */
bool identities_plot(const head_model *m, const char *folder, err *e) MUST_CHECK;
