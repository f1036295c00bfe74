#include "geometry/incisor.h"
#include "geometry/src/face/crown.h"
#include "geometry/vec.h"
#include <string.h>

/* Mean lengths of the crowns of central incisors (Wheeler's Dental Anatomy). */
static const double crown_mm[2] = {9, 10.5}; /* lower, upper */

bool incisor_find(const landmarks *l, bool upper, incisor *out)
{
    const landmark *edge = landmarks_find(l, upper ? "U1" : "L1"), *crest = landmarks_find(l, upper ? "Pr" : "Id");
    *out = (incisor){.stands_in = !edge};
    if (edge)
        vec_copy(edge->xyz, out->xyz);
    else if (!crest || !crown_over(l, crest->xyz, upper, crown_mm[upper], out->xyz))
        return false;
    strcpy(out->by, edge ? edge->label : crest->label);
    return true;
}
