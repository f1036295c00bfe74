/* outcome: what a prediction leaves on disk, with the evidence for it. */
#pragma once
#include "app/planner/predict/prediction.h"
#include "app/planner/store/output_dir.h"

typedef struct outcome_stages { /* what each took */
    clock_span prepare, judge, ready, solve, carry, write, pictures;
} outcome_stages;

typedef struct outcome { /* borrows everything */
    const case_file *patient;
    const plan_file *plan;
    const plan_moves *moves;
    const prepared *prepared;
    const plan_tissue *tissue;
    const equilibrium *solve;
    const scene_report *scene;
    const double *u;                 /* [3*nodes] displacement of the tissue, mm */
    const surface *skin;             /* predicted */
    const carried_landmarks *points; /* NULL, as u and skin, unless the solve reached equilibrium */
    const bone_depth *depth;
    contact_kind contact;    /* asked for */
    const judgement *limits; /* of bones and tissue */
    outcome_stages stages;
} outcome;

/* What a prediction with skin, landmarks and depth shows; the other stages' times are the caller's to fill in. */
outcome outcome_of(const case_file *c, const prepared *p, const plan_file *plan, const plan_moves *moves,
                   contact_kind contact, const prediction *made);
/* Meshes, moves and landmarks: skin_before.ply, skin_after.ply and .stl, segment_NAME.ply and .stl where the
 * plan puts them, NAME.tfm for each that moves, tissue.vtu with `displacement`, landmarks_planned.mrk.json.
 */
bool outcome_write_meshes(const outcome *o, const output_dir *dir, err *e) MUST_CHECK;
/* Of the residual with the bones moved; 0 where nothing moves and both are rounding. */
double outcome_relative_residual(const equilibrium *q);
/* The most compressed tet at rest: its middle, LPS mm, and how far the skin is from there. */
double outcome_worst_tet(const outcome *o, double middle[3]);
/* Where most force is left after a solve that failed: LPS mm at rest, and the landmark nearest to it; NULL: nowhere. */
const char *outcome_stuck(const outcome *o, double at[3]);
/* How far to trust the result, in a sentence. */
const char *outcome_trust(contact_kind contact);
