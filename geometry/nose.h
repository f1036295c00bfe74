/* nose: what holds the tip of the nose when the maxilla moves under it. Without it the nose is one soft lump
 * that a maxilla pushes up.
 *
 * The septal cartilage hangs on the nasal bones and on the bony septum, which stay with the cranium: Le Fort
 * I parts the septum from the maxilla's nasal crest and trims its foot (Peterson's Principles of Oral and
 * Maxillofacial Surgery 2022, chapter 63). Here it is the sheet of tets that the midplane of the nose cuts,
 * from the back of the tissue to a line from the anterior nasal spine to the septal angle behind the tip,
 * below the skin and clear of the maxilla. Its nodes at the back are tied to the cranium. The airways beside
 * it stay filled with soft tissue; how stiff that is (0.3 to 15 kPa) made no difference to the tip. */
#pragma once
#include "geometry/segment_trees.h"
#include "geometry/tissue.h"
#ifdef __cplusplus
extern "C" {
#endif

enum { REGION_SEPTUM = 3 }; /* beside those of tissue.h */

typedef struct nose_params {
    double dorsum_mm; /* soft tissue over the septum's dorsal edge */
    double tip_mm;    /* from the skin of the tip to the septal angle */
    double foot_mm;   /* gap between the septum and a maxilla that was cut from it, before and after the move */
} nose_params;

nose_params nose_params_default(void);

typedef struct nose {
    int32_t septum_tets, anchors;
    int32_t *region; /* [tets] of the tissue, with that of the nose */
    int32_t *anchor; /* [anchors] nodes where the septum hangs on the cranium */
} nose;

/* False, and nothing to free, where landmarks N, ANS or Pn are missing or there is no septum to find. at_rest: with the
 * skin. The caller frees *out. */
bool nose_make(const tissue *t, const segment_trees *at_rest, const rigid *maxilla_move, const landmarks *l,
               const nose_params *p, nose *out) MUST_CHECK;
void nose_free(nose *n);

#ifdef __cplusplus
}
#endif
