/* equilibrium: the shape of the tissue in equilibrium once the bones have moved.
 *
 * Minimises the elastic energy over the unknowns of `boundary`.
 * Large meshes: inexact Newton steps (Eisenstat & Walker 1996) by conjugate gradients, preconditioned by
 * multigrid of the matrix at the start, which is made anew when it has aged. Where a direction of negative
 * curvature is met the iteration ends there (Steihaug 1983); if such a step had to be cut, a part of the
 * clamped Hessian is mixed in as below. Where this crawls, and under contact, factors take over.
 * Small meshes, project-on-demand: the true Hessian is factorised; only where it is not positive definite is
 * a part of the one with clamped element blocks mixed in, as little as a coarse search finds enough (tissue
 * that buckles moves on quickly then), at worst the whole of it, and only where that fails too a multiple of
 * the identity is added. Between factorisations the old factor is improved by the last steps (L-BFGS: Nocedal
 * 1980, with the factor as initial matrix) while that is the cheaper way down. Steps are halved until the
 * energy falls enough (Armijo); where the fall is below rounding, until the residual falls. Under contact a
 * step that a few nodes would take too deep is not cut for all: those nodes give way at once, each to where
 * the tissue around it holds. A tet may invert on the way: the Stable Neo-Hookean energies allow it. Where the result
 * has one that is crushed beyond least_j it is guarded, and the solve goes on; what stays inverted is counted, not
 * hidden. Several equilibria can exist; the one reached depends on the load
 * path, which is recorded; src/solve/load_path.h and load.h draw what comes when. */
#pragma once
#include "sim/assemble.h"
#include "sim/contact.h"
#include "sim/targets.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum solve_outcome {
    SOLVED,
    STOPPED_MAX_ITERATIONS,
    STOPPED_LINE_SEARCH,  /* no step lowers the energy */
    STOPPED_NOT_FINITE,   /* the start has no energy: a tet inverted in a model that forbids it */
    STOPPED_SINGULAR,     /* no shift makes the matrix positive definite */
    STOPPED_MAX_HALVINGS, /* the load step became too small */
    STOPPED_MAX_WORK,     /* many times the work of a usual solve, and no equilibrium */
    STOPPED_PENETRATION,  /* in equilibrium, but tissue is deeper in bone or lip than allowed */
    STOPPED_INTERRUPTED
} solve_outcome;
const char *solve_outcome_text(solve_outcome outcome);

typedef enum hessian_kind {
    HESSIAN_TRUE,
    HESSIAN_REUSED,  /* an earlier factor and the steps since */
    HESSIAN_BLENDED, /* partly projected */
    HESSIAN_PROJECTED,
    HESSIAN_SHIFTED /* projected and shifted */
} hessian_kind;

typedef struct solve_record {
    double load;        /* 0..1 */
    int iteration;      /* from 1 at each load; 0: the start */
    double residual_mn; /* after the step: norm of the force on the unknowns */
    double tolerance_mn, energy_uj;
    double step; /* fraction of the direction taken */
    hessian_kind hessian;
    int cg_iterations; /* of conjugate gradients for this step */
    double factor_s;   /* wall time of making the matrix ready for this step */
    double min_j;
    int32_t inverted_count;
    bool contact; /* counted; false: without contact, or phase A */
} solve_record;

typedef enum predictor {
    PREDICT_RIGID,  /* free nodes follow the guide of `boundary` */
    PREDICT_ELASTIC /* and the linear response to what the guide leaves */
} predictor;

/* How the linear systems of the steps are solved. */
typedef enum linear_kind {
    LINEAR_AUTO,     /* gradients from 30,000 unknowns on, but under contact factors up to 400,000 */
    LINEAR_FACTOR,   /* Cholesky factors; time n^2, memory n^1.4 */
    LINEAR_GRADIENTS /* conjugate gradients preconditioned by multigrid, time and memory in proportion to n;
                        factors where they fail */
} linear_kind;

typedef struct solve_params {
    int load_steps;     /* >= 1 */
    int max_halvings;   /* failed loads that are tried again at half the step, in all; 0: none */
    int max_iterations; /* at one load */
    int max_work;      /* at all loads: iterations and factorisations, and 30 iterations of conjugate gradients for one.
                          A usual solve takes 10 to 100 */
    int max_step_cuts; /* halvings within one line search */
    double rel_tol;    /* of the residual with the bones moved and the free tissue carried rigidly; the last step
                          must be small too, below sqrt(rel_tol) of how far the bones move or the targets draw */
    double intermediate_rel_tol; /* the same before the last load */
    double least_j; /* of the volume at rest that each tet keeps in the result, in (0, 0.5], see src/elastic/crush.h; 0:
                       tets may turn inside out */
    double max_step_mm; /* longest move of an unknown in one iteration */
    enum predictor predictor;
    enum projection projection; /* CLAMP or ABS */
    enum linear_kind linear;
    bool reuse_factor;                  /* false: factorise in each iteration */
    int blas_threads;                   /* 1: the same bits whatever the machine is doing; see linear.h */
    bool (*interrupted)(void *context); /* NULL or asked in each iteration */
    void (*progress)(const solve_record *record, void *context); /* NULL or told after each iteration */
    void *context;
} solve_params;

solve_params solve_params_default(void);
/* Refuses (ERR_INPUT) what is out of range. */
bool solve_params_check(const solve_params *p, err *e) MUST_CHECK;

typedef struct equilibrium_problem {
    const tetmesh *mesh;
    const attach_map *attach;
    const region_material *materials;
    int32_t material_count;
    const contact_setup *contact; /* NULL: sliding and paired nodes keep in touch, nothing else touches */
    const targets *targets;       /* that points of the tissue are drawn to, or NULL. They hold it too: a part needs no
                                     bone where they, as they are when the solver is made, leave it no rigid motion */
    rigid motion[SEGMENT_COUNT];  /* where each bone goes from rest */
    const double *start_xyz;      /* [3*nodes] a guess at the result, or NULL */
} equilibrium_problem;

typedef struct equilibrium {
    solve_outcome outcome;
    double load_reached; /* last load solved; 1 exactly when SOLVED */
    int32_t node_count;
    double *xyz; /* [3*node_count] mm; of the last iterate where not SOLVED */
    int32_t record_count;
    solve_record *record; /* [record_count] every iteration of every load, failed ones too */
    int iterations, factorisations, cg_iterations, preconditioners, loads, halvings;
    double energy_uj, residual_mn, reference_mn, tolerance_mn;
    deformation_extremes extremes;
    int32_t crushed_tets;   /* that were guarded against turning inside out */
    int32_t stuck_node;     /* with the largest force that is left on unknowns, where not SOLVED, else -1 */
    contact_report contact; /* its energy is in energy_uj */
    double segment_force_mn[SEGMENT_COUNT][3]; /* with which each bone holds the tissue */
    double imbalance;                          /* |sum of these| over the sum of their node forces' norms */
    double prepare_s, assemble_s, factor_s, solve_s, total_s; /* wall time; prepare holds the ordering */
    int64_t unknown_count, matrix_entries, factor_entries;
    double factor_flops, memory_peak_mb;
} equilibrium;

/* With contact that is not held sliding and paired nodes are free, and each load is solved in two phases: A
 * without contact to a loose tolerance (the first load only, and not where rest is the answer), B with it.
 * SOLVED needs the residual below the tolerance right after colliders are renewed, and no penetration beyond
 * depth_limit_mm.
 *
 * Refuses what elements_make, boundary_make, assembly_make, linear_create and contact's own checks refuse,
 * (ERR_INPUT) parameters out of range and non-finite motions. A solve that fails is not a refusal: it returns
 * true, and outcome says why. */
bool equilibrium_solve(const equilibrium_problem *problem, const solve_params *params, equilibrium *out,
                       err *e) MUST_CHECK;
void equilibrium_free(equilibrium *q);

#ifdef __cplusplus
}
#endif
