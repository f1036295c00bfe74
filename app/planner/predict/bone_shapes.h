/* bone_shapes: the segments at rest as tissue meets them: trees for exact questions, smooth distances for contact. */
#pragma once
#include "app/planner/patient/prepared.h"
#include "geometry/distance_field.h"
#include "sim/contact.h"

typedef struct bone_shapes {
    nearest *tree[SEGMENT_COUNT]; /* NULL: the case has no such segment */
    distance_field *field[SEGMENT_COUNT];
    bone_shape shape[SEGMENT_COUNT]; /* over the fields */
} bone_shapes;

/* Fills *out in place (not to be copied); the caller frees it before p. Refuses what nearest_create refuses. */
bool bone_shapes_make(const prepared *p, bone_shapes *out, err *e) MUST_CHECK;
void bone_shapes_free(bone_shapes *s);
