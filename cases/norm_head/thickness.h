/* thickness: the depth of the soft tissue where forensic tables give it: where each is measured, and on meshes. */
#pragma once
#include "body_mesh.h"
#include "geometry/landmarks.h"
#include "norms.h"
#include "places.h"
#include "warp.h"

typedef struct thickness_site { /* on the mean head, left side or midline */
    measure_id id;
    place_on on; /* the bone below it */
    bool midline;
    double bone[3];      /* on that bone */
    double direction[3]; /* unit, outwards; the depth is measured along it */
    double skin[3];      /* where it meets the skin */
} thickness_site;

enum { THICKNESS_SITES = MEASURE_COUNT - GLABELLA_SOFT_MM };

void thickness_sites(const bodies *b, thickness_site out[THICKNESS_SITES]);
/* Adds to the pairs of the skin's warp that every depth is as asked over the warped bones. upper, lower: the warps of
 * skull and mandible. */
void thickness_targets(const thickness_site site[THICKNESS_SITES], const warp *upper, const warp *lower,
                       const double asked[MEASURE_COUNT], warp_pairs *skin);
/* On the finished meshes, into obtained[id] for every site: from the point of the bone's mesh next to the warped site
 * along the direction to the skin; of the two sides the one farther from what was asked. Refuses (ERR_GEOMETRY) a site
 * from which no skin is seen. */
bool thickness_measure(const thickness_site site[THICKNESS_SITES], const warp *upper, const warp *lower,
                       const surface *skull, const surface *mandible, const surface *skin,
                       const double asked[MEASURE_COUNT], double obtained[MEASURE_COUNT], err *e) MUST_CHECK;
