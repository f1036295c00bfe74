/* plan_contact: what tissue can touch under one plan. */
#pragma once
#include "app/planner/predict/bone_shapes.h"

typedef enum contact_kind {
    CONTACT_OFF,   /* lips and mucosa keep in touch as they are attached and slide along tangent planes at rest
                    */
    CONTACT_BONES, /* they slide along the bones' real surface instead, and no tissue enters a bone */
    CONTACT_LIPS   /* no tissue enters a bone; lips can part and meet, and mucosa can lift off */
} contact_kind;
bool contact_kind_find(const char *name, contact_kind *out);

typedef struct plan_contact {
    int32_t *extra, *upper, *lower; /* nodes; triangles of nodes */
    contact_setup setup;            /* points into this and into the shapes */
} plan_contact;

/* Mucosa that its own bone would carry into another one, or through it, as the lower lip's lining where upper
 * incisors come to stand in front of lower ones: it hangs on nothing any more, nor does the mucosa that
 * shares tets with it. Returns how many nodes. */
int32_t plan_contact_release(const tissue *t, const bone_shapes *bones, const rigid motion[SEGMENT_COUNT],
                             attach_map *attach);
/* attach, motion: of the plan; kind: not CONTACT_OFF. Nodes that more_mm of further moves could bring near bone are in
 * it too: they do no more than cost. All are borrowed; the caller frees *out first. */
void plan_contact_make(contact_kind kind, const tissue *t, const bone_shapes *bones, const attach_map *attach,
                       const rigid motion[SEGMENT_COUNT], double young_kpa, double more_mm, plan_contact *out);
void plan_contact_free(plan_contact *c);
