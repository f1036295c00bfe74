/* bone_shapes: a case's surfaces at rest as every plan asks them: trees for exact questions, smooth distances of the
 * segments for contact, what carries the landmarks, and how far the tissue is from the bones. */
#pragma once
#include "app/planner/predict/carried.h"
#include "geometry/distance_field.h"
#include "geometry/rest_gap.h"
#include "sim/contact.h"

/* What a shape asks. */
typedef struct bone_sight {
    const distance_field *field;
    const nearest *tree;
} bone_sight;

typedef struct bone_shapes {
    segment_trees trees;                  /* with the skin */
    distance_field *field[SEGMENT_COUNT]; /* NULL: the case has no such segment */
    bone_sight sight[SEGMENT_COUNT];
    bone_shape shape[SEGMENT_COUNT]; /* over them */
    landmark_carriers carriers;
    rest_gap gap; /* of the tissue */
} bone_shapes;

/* Fills *out in place (not to be copied); the caller frees it before p. Refuses what nearest_create refuses. */
bool bone_shapes_make(const prepared *p, bone_shapes *out, err *e) MUST_CHECK;
void bone_shapes_free(bone_shapes *s);
