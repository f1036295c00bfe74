/* bone_fields: smooth distances of a case's segments as contact asks them, found once where its tissue is. */
#pragma once
#include "geometry/distance_field.h"
#include "geometry/segment_trees.h"
#include "geometry/tissue.h"

typedef struct bone_fields {
    distance_samples part[SEGMENT_COUNT]; /* of segments that the case has */
} bone_fields;

/* Around the nodes on skin, bone and holes that lie near the bone; what it meets that comes from farther off is found
 * when asked. The caller frees *out. Refuses what nearest_create refuses. */
bool bone_fields_make(const segments *s, const tissue *t, bone_fields *out, err *e) MUST_CHECK;
void bone_fields_free(bone_fields *f); /* idempotent */
/* Numbers of these segments? */
bool bone_fields_sound(const bone_fields *f, const segments *s);
/* A field over one segment, its tree and what was found of it, all borrowed; the caller destroys it before them. */
distance_field *bone_field_open(const surface *part, const nearest *tree, const distance_samples *found);
