/* sawn: a bone cut once, not yet taken over. */
#pragma once
#include "geometry/src/cut/breach.h"
#include "geometry/src/cut/cut_plan.h"

typedef struct sawn {
    surface piece, rest, kerf;
    int32_t handles; /* of the bone */
    int32_t made; /* handles that piece and rest have more than the bone had; not counted in the maxilla, whose sinuses
                     a cut opens */
    breach where; /* the widest window, if made > 0 */
    double moved_mm; /* farthest that the cut was moved inwards for the lateral plate */
    cut_report report;
} sawn;

/* Cuts `bone` along b, whose piece is piece_id, and adds to out->report; the caller frees *out, whatever comes back.
 * Refuses (ERR_GEOMETRY) a cut that misses the bone and volumes that do not add up to 0.1 %. */
bool sawn_make(const char *name, const cut_bodies *b, segment_id piece_id, segment_id rest_id,
               const osteotomy_params *p, const surface *bone, sawn *out, err *e) MUST_CHECK;
void sawn_free(sawn *s);
