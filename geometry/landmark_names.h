/* landmark_names: what automatic tools call the landmarks. Only names whose meaning is beyond doubt are here. */
#pragma once
#include "geometry/landmarks.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct landmark_alias {
    const char *label; /* ours */
    const char *names; /* theirs; of several, separated by a space, the mean is meant */
} landmark_alias;

/* ALI-CBCT, of the Slicer Automated Dental Tools. */
extern const landmark_alias landmark_aliases[];
extern const int landmark_alias_count;

/* Gives points that bear another tool's name ours, unless a point has it already. Where ours is the mean of two, both
 * are needed. */
void landmark_names_resolve(landmarks *l);

#ifdef __cplusplus
}
#endif
