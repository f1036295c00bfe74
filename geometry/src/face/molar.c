#include "geometry/molar.h"
#include "geometry/incisor.h"
#include "geometry/src/face/crown.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <string.h>

/* From that tooth's buccal cusp forwards to the first molar's mesiobuccal one, by the mean widths of crowns (Wheeler's
 * Dental Anatomy: upper first molar 10, premolars 7, lower premolars 7 mm; mesiobuccal cusp 2.5 mm behind the contact).
 */
static const struct neighbour {
    char tooth;
    double forward_mm[2]; /* lower, upper */
} neighbours[] = {{'6', {0, 0}}, {'7', {0, 10}}, {'5', {-6, -6}}, {'4', {-13, -13}}};
static const double crown_mm = 7.5; /* of first molars, upper and lower (the same) */
enum { NEIGHBOURS = sizeof neighbours / sizeof *neighbours };

static const landmark *tooth_at(const landmarks *l, bool upper, char tooth, int side)
{
    const char label[] = {upper ? 'U' : 'L', tooth, '_', side > 0 ? 'L' : 'R', 0};
    if (!upper && tooth == '7') return NULL; /* L7 is the rear corner of the last molar, no cusp */
    return landmarks_find(l, label);
}

static bool over_crest(const landmarks *l, bool upper, int side, molar *out)
{
    char label[LANDMARK_LABEL_SIZE];
    snprintf(label, sizeof label, "%c6_crest_%c", upper ? 'U' : 'L', side > 0 ? 'L' : 'R');
    const landmark *crest = landmarks_find(l, label);
    *out = (molar){.stands_in = true, .on_crest = true};
    strcpy(out->by, label);
    return crest && crown_over(l, crest->xyz, upper, crown_mm, out->xyz);
}

bool molar_find(const landmarks *l, bool upper, int side, molar *out)
{
    const landmark *canine = tooth_at(l, upper, '3', side);
    incisor edge;
    const double *front = canine ? canine->xyz : incisor_find(l, upper, &edge) ? edge.xyz : NULL;
    for (int i = 0; i < NEIGHBOURS; i++) {
        const landmark *at = tooth_at(l, upper, neighbours[i].tooth, side);
        double forward[3] = {0};
        if (!at || (i && !front)) continue;
        *out = (molar){.stands_in = i > 0};
        strcpy(out->by, at->label);
        if (i) {
            vec_sub(front, at->xyz, forward);
            vec_normalize(forward);
        }
        vec_copy(at->xyz, out->xyz);
        vec_axpy(out->xyz, neighbours[i].forward_mm[upper], forward, out->xyz);
        return true;
    }
    return over_crest(l, upper, side, out);
}

bool molar_pair(const landmarks *l, bool upper, const landmark *out[2])
{
    for (int i = 0; i < NEIGHBOURS; i++) {
        out[0] = tooth_at(l, upper, neighbours[i].tooth, 1);
        out[1] = tooth_at(l, upper, neighbours[i].tooth, -1);
        if (out[0] && out[1]) return true;
    }
    return false;
}
