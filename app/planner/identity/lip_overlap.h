/* lip_overlap: the tissue at rest, as no muscle holds it: upper and lower lip one in the other, so that they press on
 * each other in the neutral shape, where they only touch. Specification 1.1, Rest Configuration. */
#pragma once
#include "geometry/tissue.h"

extern const double lip_overlap_mm; /* between the middles of the lips in front; falls to none at the corners of
                                       the mouth and as far behind */

/* rest[3*nodes]: the facing nodes of the lips each moved by half the overlap into the other lip, free along the lips,
 * and the tissue in elastic equilibrium around them with all bones where they are. Refuses (ERR_NOT_CONVERGED) where
 * none is found, (ERR_GEOMETRY) one with a tet turned inside out, (ERR_INPUT) a tissue without facing lips. */
bool lip_overlap(const tissue *t, double young_kpa, double poisson, double *rest, err *e) MUST_CHECK;
