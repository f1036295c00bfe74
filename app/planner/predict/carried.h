/* carried: where a plan takes the landmarks: on bone with their segment, on skin with the tissue. */
#pragma once
#include "app/planner/plan/plan_moves.h"
#include "app/planner/patient/prepared.h"
#include "geometry/segment_trees.h"

enum { CARRIED_BY_SKIN = -1, CARRIED_BY_NONE = -2 };

typedef struct carried_landmarks {
    landmarks after; /* same labels and order as the case's */
    int *carrier;    /* [count] segment_id, CARRIED_BY_SKIN or CARRIED_BY_NONE (off every surface: stays) */
} carried_landmarks;

/* What carries each landmark of a case. */
typedef struct landmark_carriers {
    int *carrier;        /* [count] as above */
    embedding in_tissue; /* of all of them */
} landmark_carriers;
landmark_carriers landmark_carriers_find(const prepared *p, const segment_trees *trees);
void landmark_carriers_free(landmark_carriers *c); /* idempotent */

/* u[3*nodes]: displacement of the tissue's nodes; by: of p. The caller frees *out. */
carried_landmarks carry_landmarks(const prepared *p, const landmark_carriers *by, const plan_moves *moves,
                                  const double *u);
void carried_landmarks_free(carried_landmarks *c);

/* Soft-tissue points and the bony or dental points they are compared with, and the ratio of their forward
 * moves. */
typedef struct soft_ratio {
    const char *soft, *hard;
    double soft_mm[3], hard_mm[3]; /* forward, up, left */
    double ratio;                  /* forward; NaN where the bone moves less than 1 mm forward or back */
} soft_ratio;

/* Fills out[] for the pairs whose landmarks exist; returns how many (at most SOFT_RATIOS_MAX). */
enum { SOFT_RATIOS_MAX = 8 };
int soft_ratios(const prepared *p, const carried_landmarks *c, soft_ratio out[SOFT_RATIOS_MAX]);
