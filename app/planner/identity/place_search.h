/* place_search: the template laid onto a scan by its surfaces alone, from many starts, coarse to fine. */
#pragma once
#include "app/planner/identity/place_pairs.h"
#include "app/planner/store/task.h"

enum { PLACE_STARTS = 60, PLACE_TRIED = 4 };

typedef struct place_found {
    similarity way;
    double score_mm;           /* place_pair_up's, of the finest samples */
    double median_mm;          /* of the scan's points */
    double alike[PLACE_PARTS]; /* mean cosine between normals of paired points of the scan; 0: no such part */
    double turn_spread_deg, shift_spread_mm;
} place_found;

/* False: interrupted. */
bool place_search(const place_bodies *b, const task *watch, place_found *out) MUST_CHECK;
/* Betters *way with the finest samples, and measures it. */
void place_refine(const place_bodies *b, place_found *found);
/* Fills all but the spreads for found->way. */
void place_measure(const place_bodies *b, place_found *found);
