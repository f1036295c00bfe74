/* crown: the edge of a crown that is missing, over the crest of the alveolar process. */
#pragma once
#include "geometry/landmarks.h"

/* length_mm from the crest towards the other jaw, along the head's own upright. False where the landmarks give no head
 * frame. */
bool crown_over(const landmarks *l, const double crest[3], bool upper, double length_mm, double out[3]);
