/* head_place: where the template lies on a patient as a whole, before it is bent: a turn, a shift and a size. */
#pragma once
#include "app/planner/identity/head.h"
#include "app/planner/identity/head_scan.h"
#include "app/planner/store/task.h"
#include "geometry/similarity.h"

typedef struct head_place {
    rigid motion; /* x' = motion(scale x), from the template's frame into the patient's */
    double scale; /* told, not hidden: 1.00 where the patient is as large as the template */
    bool by_landmarks;
    double median_mm;                        /* of the distances from the patient's surfaces to the placed template */
    double turn_spread_deg, shift_spread_mm; /* over those starts that end within 5 % of the best */
} head_place;

/* By the scan's landmarks where it has enough of them (four or more that the template knows, not in one plane), else by
 * its surfaces alone: iterative closest points of skin, skull and mandible, each with its own kind and trimmed both
 * ways, from 60 turns, coarse to fine. Refuses (ERR_GEOMETRY), by name: a mirrored head, units other than mm (metres,
 * cm, inches: by the size), surfaces that are no head or fit none of the starts. Without landmarks a mirrored head is
 * known by surfaces that face inwards; one whose triangles were turned over too is as good a head as the other. A head
 * in other axes (upside down, y up, RAS) is found and told in *told (may be NULL, 256 bytes, "" if there is nothing to
 * tell). */
bool head_place_find(const head_template *t, const head_scan *s, const task *watch, head_place *out, char told[256],
                     err *e) MUST_CHECK;
/* out[3*count] = the placed template's points. */
void head_place_apply(const head_place *p, const double *xyz, int32_t count, double *out);
