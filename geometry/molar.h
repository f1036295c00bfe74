/* molar: where the mesiobuccal cusp of a first molar is or, where that tooth is missing, would be by the next one or,
 * in a jaw without any, by the crest of the alveolar process. */
#pragma once
#include "geometry/landmarks.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct molar {
    double xyz[3];
    char by[LANDMARK_LABEL_SIZE]; /* the landmark that tells: "U6_L", of the next tooth, or "U6_crest_L" */
    bool stands_in;               /* of the next tooth: the place is an estimate, within a cusp's width */
    bool on_crest;                /* no tooth tells, but the crest: stands_in, a crown's length from it */
} molar;

/* side: 1 left, -1 right. The next teeth are, in this order, U7, U5 and U4, in the lower jaw L5 and L4; the place is as
 * far from theirs along the arch, towards the canine (else the incisor), as teeth are wide on average. False where
 * neither one of them nor the crest is there. */
bool molar_find(const landmarks *l, bool upper, int side, molar *out);
/* The same tooth on both sides, left first: for measures that compare them. False: no tooth is there on both. */
bool molar_pair(const landmarks *l, bool upper, const landmark *out[2]);

#ifdef __cplusplus
}
#endif
