#include "app/planner/predict/solve_report.h"
#include "app/planner/predict/outcome.h"
#include "geometry/vec.h"

static const record_row iteration_row[] = {
    ROW(solve_record, load, "load", NULL, "share of the bones' moves"),
    ROW(solve_record, iteration, "iteration", NULL, "from 1 at each load; 0: the start"),
    ROW(solve_record, residual_mn, "residual_mN", "mN", "norm of the forces that are left"),
    ROW(solve_record, tolerance_mn, "tolerance_mN", "mN", "at which this load is solved"),
    ROW(solve_record, energy_uj, "energy_uJ", "uJ", "energy"),
    ROW(solve_record, step, "step", NULL, "share of the step that was taken"),
    ROW_WORD(solve_record, hessian, "hessian", "true|reused|blended|projected|shifted", "which matrix gave it"),
    ROW(solve_record, contact, "contact", NULL, "contact was counted in"),
    ROW(solve_record, factor_s, "factor_s", "s", "wall time to make the matrix ready"),
    ROW(solve_record, min_j, "min_J", NULL, "smallest volume ratio of a tetrahedron"),
    ROW(solve_record, inverted_count, "inverted", NULL, "tetrahedra turned inside out"),
};
static const record_table iteration_table = {.title = "An iteration of the solve", RECORD_ROWS(iteration_row)};

static bool is_on(const void *of) { return ((const contact_report *)of)->on; }

#define TOUCH(member, name, unit, help) ROW_WHEN(is_on, contact_report, member, name, unit, help)
static const record_row contact_row[] = {
    ROW(contact_report, on, "on", NULL, "it was counted in"),
    TOUCH(held, "held", NULL, "lips and mucosa keep in touch"),
    TOUCH(nodes, "nodes", NULL, "nodes that could touch"),
    TOUCH(active_nodes, "touching_nodes", NULL, "nodes that do"),
    TOUCH(left_out, "left_out", NULL, "nodes of one lip that lie deep in the other at rest"),
    TOUCH(lost, "lost", NULL, "contacts given up, whose side is not clear"),
    TOUCH(pinched, "pinched", NULL, "nodes where two bones overlap"),
    TOUCH(passed, "passed", NULL, "nodes that seem to have gone right through a bone"),
    TOUCH(guards, "guards", NULL, "planes that hold nodes from that"),
    TOUCH(slide_off_mm, "slide_off_mm", "mm", "farthest that the last look moved a sliding node back to its level"),
    TOUCH(depth_mm, "depth_mm", "mm", "deepest penetration"),
    TOUCH(bone_area_mm2, "bone_area_mm2", "mm2", "area that touches bone"),
    TOUCH(lip_area_mm2, "lip_area_mm2", "mm2", "area between the lips that touches"),
    TOUCH(pressure_kpa, "pressure_kPa", "kPa", "largest pressure"),
    TOUCH(energy_uj, "energy_uJ", "uJ", "energy of the contacts"),
    TOUCH(free_iterations, "free_iterations", NULL, "iterations without contact"),
    TOUCH(contact_iterations, "contact_iterations", NULL, "iterations with it"),
    TOUCH(refreshes, "refreshes", NULL, "times that it was looked up anew what touches what"),
    TOUCH(refresh_change_mm, "last_refresh_mm", "mm", "change of the gaps in the last of them"),
    TOUCH(stiffenings, "stiffenings", NULL, "times that contacts were made stiffer"),
    TOUCH(corrections, "corrections", NULL, "times that the smooth distance of a bone was corrected by the exact one"),
    TOUCH(uncoupled, "uncoupled", NULL, "contacts of the lips that the last matrix did not hold"),
};
static const record_table contact_table = {.title = "Contact", RECORD_ROWS(contact_row)};

static const char *outcome_words(const void *of, char *space)
{
    (void)space;
    return solve_outcome_text(((const equilibrium *)of)->outcome);
}

static double is_solved(const void *of) { return ((const equilibrium *)of)->outcome == SOLVED; }
static double relative(const void *of) { return outcome_relative_residual(of); }

static const void *next_force(const void *of, int *i, const char **key, void *space)
{
    const equilibrium *q = of;
    (void)space;
    while (*i < SEGMENT_COUNT && !(vec_norm(q->segment_force_mn[*i]) > 0)) ++*i;
    if (*i == SEGMENT_COUNT) return NULL;
    *key = segment_name((segment_id)*i);
    return q->segment_force_mn[*i];
}

static const record_row solve_row[] = {
    ROW_TEXT(outcome_words, "outcome", "how it ended, in words"),
    ROW_FOUND(BOOL, is_solved, "solved", NULL, "it reached equilibrium"),
    ROW(equilibrium, iterations, "iterations", NULL, "steps of Newton's method, all loads"),
    ROW(equilibrium, factorisations, "factorisations", NULL, "matrices that were factorised"),
    ROW(equilibrium, cg_iterations, "cg_iterations", NULL, "steps of conjugate gradients"),
    ROW(equilibrium, preconditioners, "preconditioners", NULL, "times that a preconditioner was made"),
    ROW(equilibrium, loads, "loads", NULL, "loads that were solved"),
    ROW(equilibrium, halvings, "halvings", NULL, "loads that failed and were tried again at half the step"),
    ROW(equilibrium, residual_mn, "residual_mN", "mN", "norm of the forces that are left"),
    ROW(equilibrium, reference_mn, "initial_residual_mN", "mN", "the same with the bones moved and the tissue not"),
    ROW_FOUND(NUMBER, relative, "relative_residual", NULL, "the first over the second"),
    ROW(equilibrium, tolerance_mn, "tolerance_mN", "mN", "at which it is solved"),
    ROW(equilibrium, energy_uj, "energy_uJ", "uJ", "energy"),
    {.kind = RECORD_MAP,
     .next = next_force,
     .item = RECORD_NUMBERS,
     .length = 3,
     .key = "segment",
     .name = "segment_force_mN",
     .unit = "mN",
     .help = "with which each bone holds the tissue, LPS"},
    ROW(equilibrium, imbalance, "force_imbalance", NULL, "their sum over the sum of their nodes' norms"),
    ROW(equilibrium, extremes.inverted_count, "inverted_tets", NULL, "tetrahedra turned inside out"),
    ROW(equilibrium, crushed_tets, "crushed_tets", NULL, "tetrahedra that were guarded against turning inside out"),
    ROW(equilibrium, extremes.min_j, "min_J", NULL, "smallest volume ratio of a tetrahedron"),
    ROW(equilibrium, extremes.min_j_tet, "min_J_tet", NULL, "which one that is"),
    ROW(equilibrium, unknown_count, "unknowns", NULL, "numbers solved for"),
    ROW(equilibrium, factor_entries, "factor_entries", NULL, "entries of the factor"),
    ROW(equilibrium, extremes.max_stretch, "largest_stretch", NULL, "largest principal stretch"),
    ROW(equilibrium, memory_peak_mb, "memory_peak_MB", "MB", "most memory that the linear systems took"),
    ROW_OBJECT(equilibrium, contact, &contact_table, "contact", "what touches what"),
    ROW_ARRAY(equilibrium, record, record_count, &iteration_table, "record", "every iteration of every load"),
};
const record_table solve_table = {.title = "The solve", RECORD_ROWS(solve_row)};

static const char *bone(const void *of, char *space)
{
    const bone_depth *d = of;
    (void)space;
    return d->nodes ? segment_name((segment_id)d->segment) : "";
}

static const void *place(const void *of, void *space)
{
    const bone_depth *d = of;
    (void)space;
    return d->nodes ? d->at : NULL;
}

static const record_row depth_row[] = {
    ROW(bone_depth, nodes, "nodes", NULL, "nodes that are deeper than at rest by more than the limit"),
    ROW(bone_depth, limit_mm, "limit_mm", "mm", "the limit"),
    ROW(bone_depth, area_mm2, "area_mm2", "mm2", "area around them"),
    ROW(bone_depth, area_deep_mm2, "deeper_than_1mm_mm2", "mm2", "area of those more than 1 mm deeper"),
    ROW(bone_depth, depth_mm, "depth_mm", "mm", "deepest, beyond its depth at rest"),
    {.kind = RECORD_NUMBERS,
     .length = 3,
     .at = place,
     .name = "at_lps_mm",
     .unit = "LPS mm",
     .or_null = true,
     .help = "where that is"},
    ROW_TEXT(bone, "bone", "the bone it is in, empty where there is none"),
    ROW(bone_depth, from_skin_mm, "from_skin_mm", "mm", "its distance from the skin before"),
};
const record_table bone_depth_table = {.title = "Tissue in bone", RECORD_ROWS(depth_row)};
