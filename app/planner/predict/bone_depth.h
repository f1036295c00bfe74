/* bone_depth: does tissue end up inside bone? Asked of the predicted tissue and the real bones where the plan
 * puts them, whatever the solve took care of. */
#pragma once
#include "app/planner/predict/bone_shapes.h"
#include "app/planner/plan/plan_moves.h"
#include "app/planner/patient/prepared.h"

typedef struct bone_depth {
    int32_t nodes; /* on the tissue's surface, deeper in a bone than at rest by more than the limit */
    double limit_mm;
    double area_mm2;      /* around them */
    double area_deep_mm2; /* of it where they are more than 1 mm deeper */
    double depth_mm;      /* deepest, beyond its depth at rest */
    double at[3];         /* LPS mm, where the plan puts that node */
    int segment;          /* the bone it is in; -1: none is */
    double from_skin_mm;  /* distance of that node from the skin before the move */
} bone_depth;

/* xyz[3*nodes]: the tissue after the plan. */
bone_depth bone_depth_measure(const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                              const attach_map *a, const double *xyz);
