/* breach: where a cut came out of the bone in the middle of a plate. */
#pragma once
#include "geometry/landmarks.h"
#include "geometry/surface.h"

typedef struct breach {
    double place[3]; /* LPS mm, middle of the window */
    double wide_mm;  /* its longest diameter; 0: none */
} breach;

/* A cut that leaves the bone only at its rim has one border. Of each connected part of the cut face of `piece` (what
 * of it lies on the surface `cutter`) the longest border is its rim; the widest of the others is the breach. */
bool breach_find(const surface *piece, const surface *cutter, breach *out, err *e) MUST_CHECK;
/* Label of the landmark nearest to the middle of the window; "no landmark" where there is none. */
const char *breach_landmark(const breach *b, const landmarks *points);
