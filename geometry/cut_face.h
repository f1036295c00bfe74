/* cut_face: the faces that a saw cut left on two bones, and how they stand to each other after a move. */
#pragma once
#include "geometry/clash.h"
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct cut_sample { /* a piece of the face, about one spacing across */
    double p[3], n[3], mm2; /* n: unit, out of the bone */
} cut_sample;

typedef struct cut_face {
    int32_t count;
    cut_sample *sample;
    double mm2;
    surface shell; /* its triangles */
} cut_face;

typedef struct cut_bones { /* borrowed: the bones of a case with their trees, NULL where there is no such bone */
    const segments *bones;
    const distance_tree *part[SEGMENT_COUNT], *kerf;
} cut_bones;

/* The triangles of `own` that lie on the saw's bone and face `other`. May be empty. The caller frees. */
cut_face cut_face_make(const cut_bones *b, segment_id own, segment_id other, double spacing_mm);
void cut_face_free(cut_face *f);
/* The samples whose normal leans towards `way` (unit) by more than `cosine`; `two_sided`: or away from it. */
cut_face cut_face_towards(const cut_face *f, const double way[3], double cosine, bool two_sided);

typedef struct cut_contact {
    double mm2;    /* of the face that is within touch_mm of the other bone, or in it */
    double gap_mm; /* mean opening where the other bone's face still lies opposite, within 6 mm; NaN: nowhere */
} cut_contact;

/* rel takes the face's bone into the frame of the other. other_face NULL: no gap is asked for. */
cut_contact cut_contact_measure(const cut_face *f, const clash_body *other, const distance_tree *other_face,
                                const rigid *rel, double touch_mm);
/* Of the face within the other bone, the part farthest from that bone's own face: the depth of bone that must go. place
 * in the frame of the other bone; not found: no part is within it. */
clash_spot cut_face_trim(const cut_face *f, const clash_body *other, const distance_tree *other_face, const rigid *rel);

typedef struct cut_place {         /* two points that the saw parted */
    double own[3], other[3], n[3]; /* n: from own to other */
} cut_place;

/* Where the face is nearest to p. False if the face is empty. */
bool cut_place_make(const cut_face *f, const double p[3], double kerf_mm, cut_place *out);
/* Opening along the normal, mm (negative: overlap; the saw's width counts), and shift along the face. */
double cut_place_gap(const cut_place *c, const rigid *rel, double *step_mm);

#ifdef __cplusplus
}
#endif
