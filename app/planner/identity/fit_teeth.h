/* fit_teeth: each tooth turned, shifted and made larger or smaller as a whole. */
#pragma once
#include "geometry/similarity.h"
#include "geometry/surface.h"
#include "sim/target_surface.h"

/* moved: the teeth where the jaw has carried them, `as` of the template; each goes to the similarity that fits its
 * carried vertices best, then, where there is a target (else NULL), in a few rounds to what of it is nearest to its
 * crown: the vertices that are not buried[vertices]. tooth[vertices]: its number. Each keeps its size within a tenth of
 * the jaw's. */
void fit_teeth(const surface *as, const int32_t *tooth, const uint8_t *buried, const target_surface *target,
               surface *moved);
