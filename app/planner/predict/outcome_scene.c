#include "app/planner/predict/outcome_scene.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <math.h>
#include <stdarg.h>
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

/* Modelled: another sentence. */
static void model(scene_words *s, const char *fmt, ...) PRINTF_LIKE(2, 3);
static void model(scene_words *s, const char *fmt, ...)
{
    va_list args;
    assert(s->on_count < SCENE_WORDS_MAX);
    va_start(args, fmt);
    vsnprintf(s->on[s->on_count++], sizeof s->on[0], fmt, args);
    va_end(args);
}

/* NaN: the error is not known. */
static scene_omission *leave_out(scene_words *s, const char *what, const char *why)
{
    assert(s->left_out_count < SCENE_WORDS_MAX);
    scene_omission *o = &s->left_out[s->left_out_count++];
    snprintf(o->what, sizeof o->what, "%s", what);
    snprintf(o->why, sizeof o->why, "%s", why);
    o->skin_error_mm = (double)NAN;
    return o;
}

static void list_contact(const outcome *o, scene_words *out)
{
    const attach_map *a = &o->tissue->attach;
    bool sliding = false;
    for (int32_t v = 0; v < a->node_count; v++) sliding |= a->kind[v] == NODE_SLIDING;
    bool bones = o->contact != CONTACT_OFF, lips = o->contact == CONTACT_LIPS;
    if (bones) model(out, "no tissue that can move enters a segment, as scanned and cut");
    if (sliding)
        model(out, "%s",
              lips    ? "mucosa touches crowns and alveolar bone without friction and may lift off"
              : bones ? "mucosa slides along the surface of crowns and alveolar bone, always in touch"
                      : "mucosa slides along tangent planes of crowns and alveolar bone");
    if (a->pair_count)
        model(out, "%s",
              lips ? "the lips touch without friction and may part"
                   : "the lips slide along each other, always in touch");
    if (!bones) leave_out(out, "contact of tissue with bone", "--contact is off; tissue_in_bone says how deep it is");
    if (!lips)
        leave_out(out, "lips that part and meet, mucosa that lifts off",
                  "needs --contact lips, and the tone of the lips, which is not modelled");
}

static void list_plan_tissue(const outcome *o, scene_words *out)
{
    const plan_tissue *t = o->tissue;
    if (t->nose.septum_tets)
        model(out, "nasal septum as cartilage of %.0f kPa: %d tets, hung on the cranium by %d nodes",
              t->material[1].material.young_kpa, t->nose.septum_tets, t->nose.anchors);
    else if (rigid_is_identity(&o->moves->move[SEGMENT_MAXILLA]))
        leave_out(out, "nasal cartilage", "the maxilla stays where it is");
    else
        leave_out(out, "nasal cartilage",
                  "no septum was found: landmarks N, ANS and Pn, and a nose that is meshed, are needed");
    if (t->lip_nodes)
        model(out, "the lower lip falls back onto the lower teeth as they come forward (%d nodes)", t->lip_nodes);
    if (t->released) model(out, "mucosa that another bone would run over hangs on nothing (%d nodes)", t->released);
    model(
        out,
        "along the cuts of this plan moved bone carries its tissue up to the edge (%d nodes tied), bone that stays is "
        "bared (%d nodes loosened)",
        t->cuts.tied, t->cuts.loosened);
}

static void list_tissue(const outcome *o, scene_words *out)
{
    const scene_report *s = o->scene;
    char what[160], why[200];
    leave_out(out, json_string_value(json_object_get(o->prepared->report, "left_out")),
              "far from the moving bones, and not meshed: its effect is not estimated");
    if (s->full) return;
    snprintf(what, sizeof what, "%d of %d tets (%.0f cm3) far from what this plan moves", s->left_out_tets, s->tets,
             s->left_out_mm3 / 1000);
    snprintf(
        why, sizeof why,
        "expected to move less than %.2f mm; held to the cranium, the forces there asked after the solve how far it "
        "would go",
        s->tolerance_mm);
    leave_out(out, what, why)->skin_error_mm = outcome_left_out_mm(o);
}

void scene_words_make(const outcome *o, scene_words *out)
{
    char element[160];
    *out = (scene_words){.report = *o->scene, .averaged = o->tissue->material[0].material.averaged_kpa > 0};
    outcome_element_words(o, element, sizeof element);
    model(out, "elastic tissue (Stable Neo-Hookean), %s", element);
    list_contact(o, out);
    list_plan_tissue(o, out);
    leave_out(out, "expressions and jaw motion", "not built");
    list_tissue(o, out);
}

static const void *next_on(const void *of, int *i, const char **key, void *space)
{
    const scene_words *s = of;
    (void)key, (void)space;
    return *i < s->on_count ? s->on[*i] : NULL;
}

static const void *next_left_out(const void *of, int *i, const char **key, void *space)
{
    const scene_words *s = of;
    (void)key, (void)space;
    return *i < s->left_out_count ? &s->left_out[*i] : NULL;
}

static const record_row omission_row[] = {
    ROW(scene_omission, what, "what", NULL, "what is left out"),
    ROW(scene_omission, why, "why", NULL, "why"),
    ROW(scene_omission, skin_error_mm, "skin_error_mm", "mm", "how far the skin is off for it at most, by estimate"),
};
static const record_table omission_table = {.title = "Something left out", RECORD_ROWS(omission_row)};

static const record_row scene_row[] = {
    ROW_TEXTS(next_on, "on", "what is modelled, in sentences"),
    ROW_LIST(next_left_out, &omission_table, "left_out", "what is not"),
    {.kind = RECORD_WORD,
     .offset = offsetof(scene_words, averaged),
     .name = "element",
     .words = "linear|averaged",
     .help = "linear tetrahedra, or with averaged volume changes"},
    ROW(scene_words, report.full, "full", NULL, "all tetrahedra are solved for"),
    ROW(scene_words, report.tets, "tets", NULL, "tetrahedra in all"),
    ROW(scene_words, report.left_out_tets, "left_out_tets", NULL, "of them, held still"),
    ROW(scene_words, report.tolerance_mm, "tolerance_mm", "mm", "what is expected to move less is held"),
    ROW(scene_words, report.rounds, "rounds", NULL, "solves, until the tissue held would move less than that"),
    ROW(scene_words, report.error_mm, "tissue_error_mm", "mm", "farthest that a node held would still move"),
    ROW(scene_words, report.estimate_s, "estimate_s", "s", "wall time to choose what is held"),
    ROW(scene_words, report.check_s, "check_s", "s", "wall time to ask what it costs"),
};
const record_table scene_words_table = {.title = "What is modelled", RECORD_ROWS(scene_row)};
