/* face_regions: which part of the face each vertex of a skin belongs to, by boxes between landmarks. */
#pragma once
#include "geometry/frame.h"
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum face_region {                 /* disjoint */
                           FACE_OUTSIDE,   /* forehead, ears, neck, skin below the chin, back of the head */
                           FACE_NOSE,      /* N to Sn, between the alae and 2 mm more */
                           FACE_UPPER_LIP, /* Sn to stomion, between the mouth's corners */
                           FACE_LOWER_LIP, /* stomion to B' */
                           FACE_CHIN, /* B' to Me', without the skin below it: what rises behind Me' by less than 45
                                         degrees */
                           FACE_CHEEK_LEFT, /* beside these, orbitale to Me' */
                           FACE_CHEEK_RIGHT,
                           FACE_REGION_COUNT
} face_region;

const char *face_region_name(face_region r);

typedef struct face_map {
    int32_t vertex_count;
    uint8_t *region; /* face_region */
    uint8_t *lower;  /* 1: lower face, all of the above below Sn */
    uint8_t *stable; /* 1: what no operation of the jaws moves: forehead, to 60 mm above N; the dorsum of the nose over
                        its bones, the upper third of N to Sn; the sides of the orbits, from 10 mm beside Or */
} face_map;

/* In the frame of the landmarks. The face ends halfway from porion to orbitale. Refuses (ERR_INPUT, naming it) a
 * missing Po_L, Po_R, Or_L or Or_R, N, Sn, Al_L, Al_R, Ch_L, Ch_R, Stm (or Stms and Stmi), B' (or B), Me' (or Me), and
 * levels that are not in this order from above. The caller frees *out. */
bool face_map_make(const surface *skin, const landmarks *l, face_map *out, err *e) MUST_CHECK;
void face_map_free(face_map *m); /* idempotent */

#ifdef __cplusplus
}
#endif
