#include "app/planner/predict/outcome_scene.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>

/* Largest length on the skin of a displacement error[3*nodes] of the tissue. */
static double worst_on_skin(const prepared *p, const double *error)
{
    size_t n = 3 * (size_t)p->skin.vertex_count;
    double *still = NEW_ARRAY(double, n), *moved = NEW_ARRAY(double, n), worst = 0;
    embedding_apply(&p->skin_on_tissue, &p->tissue.mesh, error, still, moved);
    for (size_t i = 0; i < n; i += 3) worst = fmax(worst, vec_norm(moved + i));
    free(still);
    free(moved);
    return worst;
}

void outcome_element_words(const outcome *o, char *out, size_t size)
{
    const case_material *c = &o->patient->material;
    bool averaged = o->tissue->material[0].material.averaged_kpa > 0;
    const char *kind = averaged ? "linear tetrahedra with averaged volume changes" : "linear tetrahedra";
    if (c->element == ELEMENT_AVERAGED && !averaged)
        snprintf(out, size, "%s: up to Poisson's ratio %g nothing is averaged", kind, element_keeps);
    else if (c->element != ELEMENT_AUTO)
        snprintf(out, size, "%s, as the case asks for%s", kind,
                 !averaged && c->poisson >= element_average_from
                     ? ", though they stiffen falsely at its Poisson's ratio"
                     : "");
    else
        snprintf(out, size, "%s: Poisson's ratio %g is %s %g, from where averaging %s", kind, c->poisson,
                 averaged ? "not below" : "below", element_average_from, averaged ? "pays" : "would pay");
}

double outcome_left_out_mm(const outcome *o) { return worst_on_skin(o->prepared, o->scene->error); }

static json_t *entry(const char *what, const char *why, json_t *skin_error)
{
    return json_pack("{ss ss so}", "what", what, "why", why, "skin_error_mm", skin_error);
}

static void list_contact(const outcome *o, json_t *on, json_t *left_out)
{
    const attach_map *a = &o->tissue->attach;
    bool sliding = false;
    for (int32_t v = 0; v < a->node_count; v++) sliding |= a->kind[v] == NODE_SLIDING;
    bool bones = o->contact != CONTACT_OFF, lips = o->contact == CONTACT_LIPS;
    if (bones) json_array_append_new(on, json_string("no tissue that can move enters a segment, as scanned and cut"));
    if (sliding)
        json_array_append_new(
            on, json_string(lips    ? "mucosa touches crowns and alveolar bone without friction and may lift off"
                            : bones ? "mucosa slides along the surface of crowns and alveolar bone, always in touch"
                                    : "mucosa slides along tangent planes of crowns and alveolar bone"));
    if (a->pair_count)
        json_array_append_new(on, json_string(lips ? "the lips touch without friction and may part"
                                                   : "the lips slide along each other, always in touch"));
    if (!bones)
        json_array_append_new(left_out, entry("contact of tissue with bone",
                                              "--contact is off; tissue_in_bone says how deep it is", json_null()));
    if (!lips)
        json_array_append_new(left_out, entry("lips that part and meet, mucosa that lifts off",
                                              "needs --contact lips, and the tone of the lips, which is not modelled",
                                              json_null()));
}

static void list_plan_tissue(const outcome *o, json_t *on, json_t *left_out)
{
    const plan_tissue *t = o->tissue;
    char text[200];
    if (t->nose.septum_tets) {
        const struct material *m = &t->material[1].material;
        snprintf(text, sizeof text, "nasal septum as cartilage of %.0f kPa: %d tets, hung on the cranium by %d nodes",
                 m->young_kpa, t->nose.septum_tets, t->nose.anchors);
        json_array_append_new(on, json_string(text));
    } else if (rigid_is_identity(&o->moves->move[SEGMENT_MAXILLA]))
        json_array_append_new(left_out, entry("nasal cartilage", "the maxilla stays where it is", json_null()));
    else
        json_array_append_new(left_out, entry("nasal cartilage",
                                              "no septum was found: landmarks N, ANS and Pn, and a nose "
                                              "that is meshed, are needed",
                                              json_null()));
    if (t->lip_nodes) {
        snprintf(text, sizeof text, "the lower lip falls back onto the lower teeth as they come forward (%d nodes)",
                 t->lip_nodes);
        json_array_append_new(on, json_string(text));
    }
    if (t->released) {
        snprintf(text, sizeof text, "mucosa that another bone would run over hangs on nothing (%d nodes)", t->released);
        json_array_append_new(on, json_string(text));
    }
    snprintf(text, sizeof text,
             "along the cuts of this plan moved bone carries its tissue up to the edge (%d nodes tied), bone "
             "that stays is "
             "bared (%d nodes loosened)",
             t->cuts.tied, t->cuts.loosened);
    json_array_append_new(on, json_string(text));
}

static void list_tissue(const outcome *o, json_t *left_out)
{
    const scene_report *s = o->scene;
    char what[160], why[200];
    json_array_append_new(left_out,
                          entry(json_string_value(json_object_get(o->prepared->report, "left_out")),
                                "far from the moving bones, and not meshed: its effect is not estimated", json_null()));
    if (s->full) return;
    snprintf(what, sizeof what, "%d of %d tets (%.0f cm3) far from what this plan moves", s->left_out_tets, s->tets,
             s->left_out_mm3 / 1000);
    snprintf(why, sizeof why,
             "expected to move less than %.2f mm; held to the cranium, the forces there asked after the "
             "solve how far it "
             "would go",
             s->tolerance_mm);
    json_array_append_new(left_out, entry(what, why, json_real(outcome_left_out_mm(o))));
}

json_t *outcome_scene_json(const outcome *o)
{
    const scene_report *s = o->scene;
    json_t *on = json_array(), *left_out = json_array();
    char element[160], text[200];
    outcome_element_words(o, element, sizeof element);
    snprintf(text, sizeof text, "elastic tissue (Stable Neo-Hookean), %s", element);
    json_array_append_new(on, json_string(text));
    list_contact(o, on, left_out);
    list_plan_tissue(o, on, left_out);
    json_array_append_new(left_out, entry("expressions and jaw motion", "not built", json_null()));
    list_tissue(o, left_out);
    return json_pack("{so so ss sb si si sf si sf sf sf}", "on", on, "left_out", left_out, "element",
                     o->tissue->material[0].material.averaged_kpa > 0 ? "averaged" : "linear", "full", s->full, "tets",
                     s->tets, "left_out_tets", s->left_out_tets, "tolerance_mm", s->tolerance_mm, "rounds", s->rounds,
                     "tissue_error_mm", s->error_mm, "estimate_s", s->estimate_s, "check_s", s->check_s);
}
