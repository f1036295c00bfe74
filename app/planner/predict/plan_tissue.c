#include "app/planner/predict/plan_tissue.h"
#include <string.h>

/* Human septal cartilage: 3.0 MPa in tension (Richmon and others 2005, Am J Rhinol 19), 2.7 MPa in
 * compression (Griffin and others 2016, J Mater Sci Mater Med 27). */
static const double cartilage_kpa = 3000, cartilage_poisson = 0.3;

static bool make_materials(const case_file *c, material_model model, plan_tissue *t, err *e)
{
    t->material[0].region = REGION_ANY;
    t->material[1].region = REGION_SEPTUM;
    t->material_count = t->nose.septum_tets ? 2 : 1;
    element_kind kind = (element_kind)c->material.element;
    material *flesh = &t->material[0].material, *cartilage = &t->material[1].material;
    return material_make(model, c->material.young_kpa, c->material.poisson, flesh, e) &&
           material_make(MATERIAL_SNH_LOG, cartilage_kpa, cartilage_poisson, cartilage, e) &&
           element_choose(flesh, kind, e) && element_choose(cartilage, kind, e);
}

static void add_lip(const case_file *c, const prepared *p, const segment_trees *trees,
                    const rigid motion[SEGMENT_COUNT], plan_tissue *t)
{
    lip_rest_params params = lip_rest_params_default(c->tissue.vestibule_lower_mm);
    t->lip_nodes =
        lip_rest(&p->tissue, trees->part[SEGMENT_DISTAL], motion, &p->points, &p->frame, &params, &t->attach);
}

static void add_nose(const prepared *p, const segment_trees *trees, const rigid motion[SEGMENT_COUNT], plan_tissue *t)
{
    const rigid *maxilla = &motion[SEGMENT_MAXILLA];
    nose_params params = nose_params_default();
    if (rigid_is_identity(maxilla) || !nose_make(&p->tissue, trees, maxilla, &p->points, &params, &t->nose)) return;
    for (int32_t i = 0; i < t->nose.anchors; i++) {
        t->attach.kind[t->nose.anchor[i]] = NODE_TIED;
        t->attach.segment[t->nose.anchor[i]] = SEGMENT_CRANIUM;
    }
    t->mesh.region = t->nose.region;
}

bool plan_tissue_make(const case_file *c, const prepared *p, const bone_shapes *shapes,
                      const rigid motion[SEGMENT_COUNT], bool free_lips, material_model model, plan_tissue *out, err *e)
{
    plan_tissue t = {.mesh = p->tissue.mesh};
    plan_attach_params along_cuts = plan_attach_params_default(c->tissue.cut_band_mm);
    plan_attach(&p->tissue, &shapes->gap, motion, &along_cuts, &t.attach, &t.cuts);
    add_nose(p, &shapes->trees, motion, &t);
    if (!free_lips) add_lip(c, p, &shapes->trees, motion, &t);
    bool ok = make_materials(c, model, &t, e);
    if (ok)
        *out = t;
    else
        plan_tissue_free(&t);
    return ok;
}

void plan_tissue_free(plan_tissue *t)
{
    attach_map_free(&t->attach);
    nose_free(&t->nose);
    *t = (plan_tissue){0};
}
