/* tissue_fissure: opens the mesh along the lip sheet, so that upper and lower lip are separate bodies. Private. */
#pragma once
#include "geometry/src/tissue/tissue_domain.h"

typedef struct lip_pairs {
    int32_t count;
    int32_t *node; /* [2*count] upper, lower; same place */
} lip_pairs;

/* Splits every node on the sheet between the mouth corners; new nodes go behind the old ones. side (grown with the
 * mesh) is inherited. The caller frees out->node. */
void tissue_open_lips(const tissue_domain *d, tetmesh *m, uint8_t **side, lip_pairs *out);
