/* fit_state: a fit under way. */
#pragma once
#include "app/planner/identity/fit_lattice.h"
#include "app/planner/identity/head_fit.h"

typedef struct fit_state {
    const head_template *t;
    const head_fit_params *params;
    const task *watch;
    target_surface *target[CASE_SURFACE_COUNT]; /* NULL: the patient has none */
    surface at[CASE_SURFACE_COUNT];             /* the template's parts where they are now */
    surface placed[CASE_SURFACE_COUNT];         /* and before they were bent */
    double *nodes, *placed_nodes;               /* [3*nodes] of the tissue at neutral, the same two */
    bool known; /* every vertex of `at` is where the patient has it: only the tissue is sought */
    uint8_t *buried[CASE_SURFACE_COUNT]; /* [vertices] of teeth: 1 in the bone or next to it; else NULL */
    fit_cost cost;
} fit_state;

/* head_fit.c: the template as it was placed (or params->from), and what the fit came to: shape, tets, cost. fit_keep
 * refuses (ERR_NOT_CONVERGED) a tet that is inside out. */
fit_state fit_begin(const head_template *t, const head_scan *s, const head_fit_params *params, const task *watch,
                    const head_place *place);
bool fit_keep(const fit_state *f, head_fit *out, err *e) MUST_CHECK;
void fit_end(fit_state *f);

/* fit_measure.c: gaps both ways and guesses of a part as it is. */
void fit_measure_part(const fit_state *f, const head_scan *s, case_surface p, head_fit *out);

/* fit_bones.c: bends all as one, then each bone on its own, and lets the teeth follow. */
/* 1 for each vertex of the teeth that lies in its jaw or next to it; the caller frees. */
uint8_t *fit_buried(const surface *teeth, const surface *jaw);
bool fit_bend(fit_state *f, err *e) MUST_CHECK;
bool fit_bones(fit_state *f, err *e) MUST_CHECK;
/* fit_tissue.c: the tissue between the bones where they are now and the patient's skin, then the skin: what hangs in
 * the tissue goes with it, the rest through a lattice. */
bool fit_tissue(fit_state *f, err *e) MUST_CHECK;
bool fit_skin(fit_state *f, err *e) MUST_CHECK;
/* rest[3*nodes]: what the template's tissue does from neutral to rest, turned and stretched as the tissue is at
 * nodes[3*nodes], less where that would turn a tet inside out. */
void fit_rest(const head_template *t, const double *nodes, double *rest);
