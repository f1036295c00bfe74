/* tissue_attach: moves wrap nodes onto the bone and decides what is tied, slides or hangs loose. Private. */
#pragma once
#include "geometry/src/tissue/tissue_domain.h"
#include "geometry/src/tissue/tissue_fissure.h"

/* Moves nodes with side BONE onto the bone where no tet flattens; the others become SIDE_HOLE. */
bool tissue_snap_to_bone(const tissue_input *in, const tissue_domain *d, tetmesh *m, uint8_t *side,
                         tissue_report *report, err *e) MUST_CHECK;
bool tissue_attach(const tissue_input *in, const tissue_domain *d, const tetmesh *m, const uint8_t *side,
                   const lip_pairs *lips, attach_map *out, tissue_report *report, err *e) MUST_CHECK;
