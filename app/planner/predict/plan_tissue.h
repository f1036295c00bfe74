/* plan_tissue: the tissue as one plan meets it: attachments along the cuts that open, cartilage where the
 * nose needs it, and the materials. */
#pragma once
#include "app/planner/predict/bone_shapes.h"
#include "geometry/lip_rest.h"
#include "geometry/nose.h"
#include "geometry/plan_attach.h"
#include "sim/element.h"

typedef struct plan_tissue {
    tetmesh mesh; /* nodes and tets are those of the prepared tissue (borrowed); the regions may be the nose's */
    attach_map attach;
    nose nose; /* none where the maxilla stays */
    plan_attach_report cuts;
    int32_t released;  /* mucosa that another bone would run over, free now; see plan_contact_release */
    int32_t lip_nodes; /* of the lower lip's lining, that fall back onto the teeth */
    region_material material[2];
    int32_t material_count;
} plan_tissue;

/* free_lips: lips and mucosa will be left to touch by themselves, so that the lower lip is not laid onto the
 * teeth. model: of flesh. shapes: of p. The caller frees *out before p. Refuses what material_make
 * refuses. */
bool plan_tissue_make(const case_file *c, const prepared *p, const bone_shapes *shapes,
                      const rigid motion[SEGMENT_COUNT], bool free_lips, material_model model, plan_tissue *out,
                      err *e) MUST_CHECK;
void plan_tissue_free(plan_tissue *t);
