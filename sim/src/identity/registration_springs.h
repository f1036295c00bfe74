/* registration_springs: the springs of a registration, and where each draws to. */
#pragma once
#include "sim/registration.h"
#include "sim/targets.h"

typedef struct registration_springs {
    const registration_problem *problem;
    targets t;          /* carried vertices part by part, then anchors */
    int32_t *part, *of; /* [count] registration_part and vertex of it; -1 and point: an anchor */
    double *area;       /* [count] mm^2, times the weight of the part */
    double *give;       /* [count] 1, less where the spring gave way */
    double *gap_mm;     /* [count] to its place in the last round, HUGE_VAL: nowhere */
} registration_springs;

/* What one round draws with. */
typedef struct registration_round {
    double stiffness_kpa_mm; /* per mm^2 */
    target_rules rules;
    double across;
} registration_round;

registration_springs registration_springs_make(const registration_problem *problem);
void registration_springs_free(registration_springs *s);
/* Places, normals and stiffnesses for the body at x[3*nodes]. */
void registration_springs_aim(registration_springs *s, const registration_round *round, const double *x);
/* Springs within two tets of one whose det F at x is below min_j give way, anchors to an eighth and others to a
 * half; returns how many tets there are. */
int32_t registration_springs_give(registration_springs *s, const double *x, double min_j);
