/* Private: the lamps of the studio. */
#pragma once
#include "render/camera.h"
#include "render/src/studio.h"

typedef struct lamps {
    double key[3], fill[3]; /* unit, world directions towards the lamps, for the highlights */
} lamps;

lamps lamps_of(const camera *c);
/* Spherical harmonics of the whole light, as a model sees it that is turned by `turn` (3 colours each). */
void lamps_project(const camera *c, const rigid *turn, float light[3 * HARMONICS]);
