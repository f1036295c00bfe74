/* place_pairs: points of the template and of a scan, each paired with the nearest of the same part of the other. */
#pragma once
#include "app/planner/identity/head.h"
#include "app/planner/identity/head_scan.h"
#include "geometry/nearest.h"
#include "geometry/similarity.h"

enum { PLACE_PARTS = 3 }; /* skin, skull, mandible */
typedef enum place_side { PLACE_TEMPLATE, PLACE_SCAN } place_side;

/* How densely: what is asked, and what is asked for. */
typedef enum place_level { PLACE_COARSE, PLACE_MIDDLE, PLACE_FINE, PLACE_LEVELS } place_level;

typedef struct place_cloud { /* points of a surface, evenly by area */
    int32_t count;
    double *at, *normal; /* [3*count] */
} place_cloud;

typedef struct place_bodies { /* of both sides; a part that one of them lacks has no trees */
    const surface *mesh[2][PLACE_PARTS];
    nearest *tree[2][PLACE_PARTS];
    place_cloud cloud[PLACE_FINE][2][PLACE_PARTS]; /* stand for the surface while the place is not yet right */
} place_bodies;

bool place_bodies_make(const head_template *t, const head_scan *s, place_bodies *out, err *e) MUST_CHECK;
void place_bodies_free(place_bodies *b);

typedef struct place_sample {
    double at[3], normal[3]; /* on its own side */
    int part;
    place_side side;
} place_sample;
/* Evenly by area, of each part of both sides: 60, 200 or 600 points. Returns their number; the caller frees. */
int32_t place_samples(const place_bodies *b, place_level level, place_sample **out);

typedef enum place_facing { FACING_ANY, FACING_ALIKE } place_facing;

typedef struct place_gap {
    plane_pair pair;    /* both points where the scan is; weight 0: refused */
    double distance_mm; /* in the scan's size */
    double alike;       /* cosine between the normals */
    bool known;         /* `found` is the answer of the last time, from which the next is looked for */
    double found[3];    /* on the other side */
    int32_t triangle;
} place_gap;
/* Pairs all samples under `way` (from the template into the scan). Of the scan's points of a part the nearest 75 %
 * count, of the template's those that lie no farther than 1.5 times as far as these: a scan is partial. out[count], all
 * zero the first time. Returns the score: mean distance with 12 mm as the most, the template's points by half, mm. */
double place_pair_up(const place_bodies *b, place_level level, const place_sample *s, int32_t count,
                     const similarity *way, place_facing facing, place_gap *out);
