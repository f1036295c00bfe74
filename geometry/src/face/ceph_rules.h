/* ceph_rules: how the points of a measure are combined; cephalometry.c has the formulas. */
#pragma once
#include "geometry/cephalometry.h"

/* p0, p1 ... are the points in the order of the table. */
typedef enum ceph_rule {
    ANGLE,         /* at p1 between p0 and p2 */
    CONVEXITY,     /* 180 - angle at p1, positive where p1 lies in front of p0 p2 */
    ANGLE_CHANGE,  /* angle p0 p1 p2 less angle p0 p1 p3 */
    VECTORS,       /* between p0->p1 and p2->p3 */
    TILT,          /* of p2->p3 against p0->p1, positive: downward */
    TILT_FH,       /* of p0->p1 against Frankfort, positive: downward */
    ANGLE_BACK_FH, /* between Frankfort backward and p0->p1 */
    DISTANCE,      /* p0 p1 */
    FORWARD,       /* of p1 from p0, along Frankfort */
    UP,            /* of p1 from p0 */
    HP_ALONG,      /* of p3 from p2 along COGS' horizontal: p0->p1 = S->N turned 7 degrees down */
    HP_DOWN,       /* of p3 below p2, perpendicular to it */
    IN_FRONT,      /* of p2 in front of the line p0 p1 */
    WITS,          /* p2 in front of p3 along p1->p0 */
    SHARE,         /* of the height p0 p2 that p0 p1 takes, % */
    WIDTH,         /* p0 p1 in space */
    LEFT,          /* of p1 from p0 */
    CANT           /* of p0 (left) to p1 (right) against the horizontal, positive: left side down */
} ceph_rule;
