/* prediction: the face after a plan, in one call that everything asks which predicts.
 *
 *   flesh     attachments, nose and lower lip as the plan meets them        plan_tissue
 *   release   mucosa that another bone would run over hangs on nothing     plan_contact
 *   touch     what can touch what                                          plan_contact
 *   solve     of the tissue that the plan needs                            sim/scene
 *   carry     skin and landmarks with the tissue                           embedding, carried
 *   evidence  tissue in bone, and the limits that only tissue answers      bone_depth, judge_tissue */
#pragma once
#include "app/planner/judge/judge.h"
#include "app/planner/predict/bone_depth.h"
#include "app/planner/predict/carried.h"
#include "app/planner/predict/plan_contact.h"
#include "app/planner/predict/plan_tissue.h"
#include "app/planner/store/task.h"
#include "sim/scene.h"

/* What is asked, and so what is left out. */
typedef struct prediction_options {
    contact_kind contact;
    bool full;               /* all tissue is solved for; else what is expected to move less than scene_mm is held */
    double scene_mm;         /* not looked at with full */
    double rel_tol;          /* of the solve, as in solve_params */
    int load_steps;          /* 0: the solver's own */
    double least_j;          /* of the volume at rest that each tet keeps; 0: tets may turn inside out */
    material_model model;    /* of flesh; its numbers are the case's */
    double watch_more_mm;    /* nodes so much farther from bone are in the contacts as well, see plan_contact_make */
    bool skin;               /* predicted skin wanted */
    bool points;             /* carried landmarks wanted */
    bool depth;              /* tissue in bone wanted */
    const double *start_xyz; /* [3*nodes] a guess at the result, or NULL: from rest */
    const judgement *bones;  /* to which the tissue's findings are added; NULL: to none */
} prediction_options;

/* What gnathos predict does: contact with bones, the scene of the plan, and all that can be told. */
prediction_options prediction_options_default(void);

typedef struct prediction {
    plan_tissue flesh;
    equilibrium solve;
    scene_report scene;
    double *u;                /* [3*nodes] displacement, mm; NULL unless SOLVED, and so is what follows */
    surface skin;             /* no vertices where not wanted */
    carried_landmarks points; /* no landmarks where not wanted */
    bone_depth depth;
    judgement limits;                              /* bones as given, and tissue */
    clock_span ready_span, solve_span, shown_span; /* until the solve, the solve, what is made of it */
} prediction;

/* shapes: bone_shapes of p, or NULL: made here. A solve that fails is not a
 * refusal: it returns true, and solve.outcome says why. Refuses what plan_tissue_make, bone_shapes_make and
 * scene_solve refuse, and (ERR_INTERRUPTED) an interruption. p must outlive *out; the caller frees it. */
bool prediction_make(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                     const prediction_options *options, const task *watch, prediction *out, err *e) MUST_CHECK;
void prediction_free(prediction *p); /* idempotent */

/* The same in parts, for who keeps a solver: see live.h. Between them stands the solve, which fills
 * prediction.solve and prediction.scene. */
typedef struct prediction_setup {
    plan_contact touch;
    equilibrium_problem problem; /* points into this and into the prediction: neither is to be moved */
    solve_params params;
    scene_params scene;
} prediction_setup;

/* Flesh, release and touch. *setup is freed first. */
bool prediction_begin(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                      const prediction_options *options, const task *watch, prediction *out, prediction_setup *setup,
                      err *e) MUST_CHECK;
void prediction_setup_free(prediction_setup *s);
/* Carry and evidence. Refuses an interrupted solve; the caller still frees *io then. */
bool prediction_end(const case_file *c, const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                    const prediction_options *options, prediction *io, err *e) MUST_CHECK;
