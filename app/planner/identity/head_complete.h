/* head_complete: a whole head of a scan that is not: what the scan lacks (crown, neck, teeth, a bone or a part of it)
 * is the template's, or that of the likeliest head of a model, bent along with what is there; an open mouth is closed.
 * All that is not where the scan has it is marked in head_fit.guessed. */
#pragma once
#include "app/planner/identity/head_fit.h"
#include "app/planner/identity/head_jaw.h"
#include "app/planner/identity/head_likeliest.h"

typedef struct head_completion {
    head_closing jaw;
    head_likeliest likeliest; /* of the model */
} head_completion;

/* m: NULL or a model of the template's numbering, of which the likeliest head by the parts that the scan has is bent in
 * place of the template's own. Refuses what head_fit_from, head_jaw_close and head_likeliest_make refuse. The caller
 * frees *out. */
bool head_complete(const head_template *t, const head_scan *s, const head_model *m, const head_place *place,
                   const task *watch, head_fit *out, head_completion *how, err *e) MUST_CHECK;
