/* live: predictions of one case, one plan after the other, that keep what the next plan can use: the prepared case, the
 * bones' shapes, the solver with its pattern and ordering, the contacts and the last solution.
 *
 * All tissue is solved for, whatever the options' scene: nothing is left out, and the report says so. A result is held
 * to the same tolerance as a prediction with `full`; the way there begins at the last plan, so where several equilibria
 * exist (tissue that went round a tooth) it can be another one.
 *
 * The solver is kept while the plan meets the tissue alike: the same nodes tied, sliding and paired, the same
 * cartilage. Else a new one takes over the contacts, and the last solution is still where it starts. A plan that moves
 * a bone farther than 5 mm from the last one starts from rest. */
#pragma once
#include "app/planner/predict/prediction.h"

typedef struct live live;

/* c and p are borrowed until live_free; options' start_xyz, bones and full are not looked at. shapes: of p, borrowed,
 * or NULL: made here. repeatable: what a plan gives depends on it and its start
 * alone, to the bit, not on the plans before; only pattern and ordering are kept then. Refuses what bone_shapes_make
 * refuses. The caller frees *out. */
bool live_create(const case_file *c, const prepared *p, const bone_shapes *shapes, const prediction_options *options,
                 bool repeatable, live **out, err *e) MUST_CHECK;
void live_free(live **l); /* idempotent */

/* The next plan, as prediction_make; start_xyz[3*nodes]: a guess at the result, or NULL: the last plan's, or rest where
 * repeatable. bones: what bone and teeth said, or NULL. *out does not depend on l, p must outlive it; the caller frees
 * it. After a refusal or a failed solve the last solution stays. */
bool live_predict(live *l, const plan_moves *moves, const double *start_xyz, const judgement *bones, const task *watch,
                  prediction *out, err *e) MUST_CHECK;
