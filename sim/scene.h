/* scene: what a plan needs of the tissue, and what leaving the rest out costs.
 *
 * Tissue that stays where it is need not be solved for. Before the solve the displacement of every node is
 * estimated: the length of the bones' moves against the cranium, continued into the tissue as a harmonic
 * function and then widened. Nodes that are expected to move less than the tolerance are held where the
 * cranium is, and tets without an unknown go. After the solve the held nodes are asked: the forces left on
 * them, through the linear response of the whole tissue at rest, say how far it would still move, to first
 * order. Where that is more than the tolerance, those nodes are freed and the plan is solved again from
 * there. */
#pragma once
#include "sim/equilibrium.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_params {
    double tolerance_mm; /* displacement that may be missed */
    int max_rounds;      /* solves in all; the last one takes everything. 1: no second solve */
    bool full;           /* everything is solved for, nothing is estimated; so it is where there are targets */
} scene_params;

scene_params scene_params_default(void);

typedef struct scene_report {
    bool full; /* everything was solved for, by choice or because nothing could be left out */
    double tolerance_mm;
    int rounds;
    int32_t nodes, tets, left_out_nodes, left_out_tets; /* nodes and tets in all; left out in the last round */
    double left_out_mm3;
    double *error;   /* [3*nodes] mm: how far each node would still move, were nothing left out; zero where nothing is.
                        The caller frees (scene_report_free) */
    double error_mm; /* largest length in it */
    double estimate_s, check_s;
} scene_report;

void scene_report_free(scene_report *r);

/* How far each node is expected to move against the cranium, at most, mm; estimate[nodes]. A guess from
 * measurements, not a bound: scene_check is what tells. */
void scene_estimate(const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT], double *estimate);
/* How far nodes that were held (held[nodes] != 0) would move from x[3*nodes] were they free; error[3*nodes].
 * Refuses what equilibrium_solve refuses. */
bool scene_check(const equilibrium_problem *problem, const uint8_t *held, const double *x, double *error,
                 err *e) MUST_CHECK;

/* equilibrium_solve with what the plan needs: *out is of the whole mesh, its records and costs are those of
 * all rounds. The caller frees both. */
bool scene_solve(const equilibrium_problem *problem, const scene_params *scene, const solve_params *params,
                 equilibrium *out, scene_report *report, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
