/* lip_rest: where the lower lip comes to rest once the mandible is brought forward under the upper teeth.
 *
 * A closed lower lip lies on whichever teeth stand in front. Behind a large overjet that are the upper
 * incisors: they hold its lining off the lower ones. When the lower teeth come forward the lip has no reason
 * to stay as far in front of them: muscle tone lets it fall back onto them (the strained lower lip relaxes
 * after surgery: Kim and others 2019, MICCAI), and it gets thinner over L1, by 2.8 +- 2.0 mm where L1
 * advanced 6 mm (Veltkamp and others 2002, AJODO). So the lining in front of the lower teeth slides on them,
 * nearer than before by the way that the lower teeth made against the upper ones, until it lies on them. */
#pragma once
#include "geometry/rigid.h"
#include "geometry/nearest.h"
#include "geometry/tissue.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct lip_rest_params {
    double reach_mm; /* lining farther than this from the lower teeth is not held off by the upper ones */
    double touch_mm; /* nearer than this it lies on them already */
    double depth_mm; /* of the lower vestibule, from the incisal edge */
} lip_rest_params;

lip_rest_params lip_rest_params_default(double vestibule_lower_mm);

/* Turns free nodes of the lower lip's lining into sliding ones with a shift, in a->shift_mm (made where there
 * was none). Returns how many; 0 where the mandible does not come forward against the maxilla, or landmarks L1,
 * L6_L and L6_R are missing, or
 * there is no mandible (NULL). */
int32_t lip_rest(const tissue *t, const nearest *mandible, const rigid motion[SEGMENT_COUNT], const landmarks *l,
                 const head_frame *f, const lip_rest_params *p, attach_map *a);

#ifdef __cplusplus
}
#endif
