/* head_likeliest: of all heads of a model the likeliest one by what a scan has of a head. */
#pragma once
#include "app/planner/identity/head_fit.h"
#include "app/planner/identity/head_model.h"

typedef struct head_likeliest {
    int32_t mode_count; /* of the model; 0: there was none */
    double p[HEAD_MODES_MOST];
    double noise_mm; /* standard deviation that a coordinate of the fit was taken to have */
} head_likeliest;

/* Least squares over what the fit has not guessed of skin, bones and teeth, weighted as the model is, with the
 * variances of its modes as prior (principal_complete); the model is turned and shifted onto the head meanwhile, its
 * size is its own. Neighbouring vertices are off together, so that many of them say little more than one: the noise is
 * as large. Where the likeliest head is none (head_sound) the scan is believed half as much, up to 4 times. *out in the
 * frame of the fit; the caller frees. Refuses (ERR_GEOMETRY) where none of these is a head or the fit has nothing of
 * the scan. */
bool head_likeliest_make(const head_template *t, const head_model *m, const head_fit *f, head_likeliest *how,
                         head_shape *out, err *e) MUST_CHECK;
