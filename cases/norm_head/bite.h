/* bite: the lower teeth of a shaped head, each brought into contact with the upper ones. */
#pragma once
#include "geometry/landmarks.h"
#include "geometry/surface.h"
#include "places.h"

/* Raises or lowers each lower tooth behind the lateral incisors (whose place overjet and overbite decide) along the
 * head's vertical until it touches the upper teeth, at most 3 mm up (the canine 1 mm: it may pass beside its opponent)
 * and 2.5 mm down. Its landmarks go along. Both surfaces: 2 TEETH_PER_SIDE shells of equal size, left side first. */
bool bite_settle(const surface *upper, surface *lower, const place *list, int count, landmarks *points,
                 err *e) MUST_CHECK;
