/* incisor: where the edge of the central incisors is or, where these are missing, would be over the alveolar process.
 */
#pragma once
#include "geometry/landmarks.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct incisor {
    double xyz[3];
    char by[LANDMARK_LABEL_SIZE]; /* the landmark that tells: "U1", "L1"; "Pr" or "Id" where the teeth are missing */
    bool stands_in;               /* of Pr or Id: the place is an estimate, a crown's length from the crest */
} incisor;

/* False where neither is there, or no head frame (frame.h) that tells up and down for the estimate. */
bool incisor_find(const landmarks *l, bool upper, incisor *out);

#ifdef __cplusplus
}
#endif
