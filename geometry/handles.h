/* handles: how often a closed surface is pierced through. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

/* The genus of every connected piece, summed: 0 for a ball, 1 for a ring. From V - E + F; s must be closed, and no
 * vertex may be shared by two sheets. */
int32_t surface_handles(const surface *s);

#ifdef __cplusplus
}
#endif
