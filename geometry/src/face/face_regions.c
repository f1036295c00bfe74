#include "geometry/face_regions.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>

static const double nose_margin_mm = 2, stable_height_mm = 60, dorsum_share = 1 / 3.0, dorsum_half_mm = 8, rim_mm = 10;

const char *face_region_name(face_region r)
{
    static const char *const name[FACE_REGION_COUNT] = {"outside", "nose",       "upper lip",  "lower lip",
                                                        "chin",    "left cheek", "right cheek"};
    return name[r];
}

void face_map_free(face_map *m)
{
    free(m->region);
    free(m->lower);
    free(m->stable);
    *m = (face_map){0};
}

/* The first of the labels that is there, in the frame: left, posterior, up. */
static bool place(const landmarks *l, const head_frame *f, const char *label, const char *instead, double out[3],
                  err *e)
{
    const landmark *p = landmarks_find(l, label);
    if (!p && instead) p = landmarks_find(l, instead);
    if (!p)
        return err_set(e, ERR_INPUT, "landmark %s%s%s is missing: the regions of the face need it", label,
                       instead ? " or " : "", instead ? instead : "");
    head_frame_to_local(f, p->xyz, out);
    return true;
}

typedef struct borders {
    double nasion, orbitale, subnasale, stomion, fold, menton; /* up */
    double back, menton_back, nasion_back;                     /* posterior */
    double nose[2], mouth[2], middle, orbit;                   /* left: right border, left border */
} borders;

static bool find_borders(const landmarks *l, const head_frame *f, borders *b, err *e)
{
    double n[3], orb[3], sn[3], al[2][3], ch[2][3], stm[3], fold[3], me[3], lower[3];
    if (!place(l, f, "N", NULL, n, e) || !place(l, f, "Or_L", "Or_R", orb, e) || !place(l, f, "Sn", NULL, sn, e) ||
        !place(l, f, "Al_R", NULL, al[0], e) || !place(l, f, "Al_L", NULL, al[1], e) ||
        !place(l, f, "Ch_R", NULL, ch[0], e) || !place(l, f, "Ch_L", NULL, ch[1], e) ||
        !place(l, f, "Stm", "Stms", stm, e) || !place(l, f, "B'", "B", fold, e) || !place(l, f, "Me'", "Me", me, e))
        return false;
    if (!landmarks_find(l, "Stm")) { /* parted lips: the border lies halfway */
        if (!place(l, f, "Stmi", NULL, lower, e)) return false;
        stm[2] = (stm[2] + lower[2]) / 2;
    }
    *b = (borders){.nasion = n[2],
                   .orbitale = orb[2],
                   .subnasale = sn[2],
                   .stomion = stm[2],
                   .fold = fold[2],
                   .menton = me[2],
                   .back = orb[1] / 2,
                   .menton_back = me[1],
                   .nasion_back = n[1],
                   .orbit = fabs(orb[0] - sn[0]),
                   .middle = sn[0],
                   .nose = {al[0][0] - nose_margin_mm, al[1][0] + nose_margin_mm},
                   .mouth = {ch[0][0], ch[1][0]}};
    if (!(b->nasion > b->orbitale && b->orbitale > b->subnasale && b->subnasale > b->stomion && b->stomion > b->fold &&
          b->fold > b->menton))
        return err_set(e, ERR_INPUT, "N, Or, Sn, stomion, B' and Me' are not in this order from above");
    if (!(b->mouth[0] < b->middle && b->middle < b->mouth[1] && b->nose[0] < b->middle && b->middle < b->nose[1]))
        return err_set(e, ERR_INPUT, "Sn does not lie between Ch_R and Ch_L and between Al_R and Al_L");
    return true;
}

static face_region region_of(const borders *b, const double p[3])
{
    double left = p[0], up = p[2];
    if (p[1] > b->back || up > b->nasion || up <= b->menton) return FACE_OUTSIDE;
    if (up > b->subnasale) {
        if (left > b->nose[0] && left < b->nose[1]) return FACE_NOSE;
        if (up > b->orbitale) return FACE_OUTSIDE;
    } else if (left > b->mouth[0] && left < b->mouth[1]) {
        if (up > b->fold) return up > b->stomion ? FACE_UPPER_LIP : FACE_LOWER_LIP;
        return p[1] - b->menton_back > up - b->menton ? FACE_OUTSIDE : FACE_CHIN;
    }
    return left > b->middle ? FACE_CHEEK_LEFT : FACE_CHEEK_RIGHT;
}

/* What no operation of the jaws moves. */
static bool is_stable(const borders *b, const double p[3])
{
    double aside = fabs(p[0] - b->middle);
    if (p[1] > b->back || p[2] > b->nasion + stable_height_mm) return false;
    if (p[2] > b->nasion) return true;
    bool dorsum = aside < dorsum_half_mm && p[2] > b->nasion - dorsum_share * (b->nasion - b->subnasale) &&
                  p[1] < b->nasion_back + dorsum_half_mm;
    return dorsum || (aside > b->orbit + rim_mm && p[2] > b->orbitale);
}

bool face_map_make(const surface *skin, const landmarks *l, face_map *out, err *e)
{
    head_frame f;
    borders b;
    if (!head_frame_from_landmarks(l, &f, e) || !find_borders(l, &f, &b, e)) return false;
    face_map m = {skin->vertex_count, NEW_ARRAY(uint8_t, skin->vertex_count), NEW_ARRAY(uint8_t, skin->vertex_count),
                  NEW_ARRAY(uint8_t, skin->vertex_count)};
    for (int32_t v = 0; v < skin->vertex_count; v++) {
        double p[3];
        head_frame_to_local(&f, skin->xyz + 3 * (size_t)v, p);
        m.region[v] = (uint8_t)region_of(&b, p);
        m.lower[v] = m.region[v] != FACE_OUTSIDE && p[2] <= b.subnasale;
        m.stable[v] = is_stable(&b, p);
    }
    *out = m;
    return true;
}
