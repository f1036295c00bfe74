/* The record of a study. */
#include "app/study/record.h"
#include <math.h>

typedef struct run_view {
    const char *group, *setting;
    study_result r;
    study_error error, change;
    double meshing_s;
    bool front;
} run_view;

static const record_row run_row[] = {
    ROW(run_view, group, "group", NULL, "what the setting is about"),
    ROW(run_view, setting, "setting", NULL, "the setting"),
    ROW(run_view, r.text, "outcome", NULL, "how it ended, in words"),
    ROW(run_view, r.solved, "solved", NULL, "it reached equilibrium"),
    ROW(run_view, front, "front", NULL, "nothing is both faster and nearer to the reference in the mean"),
    ROW(run_view, r.nodes, "nodes", NULL, "nodes of the mesh"),
    ROW(run_view, r.tets, "tets", NULL, "its tetrahedra"),
    ROW(run_view, r.unknowns, "unknowns", NULL, "numbers solved for"),
    ROW(run_view, r.size_mm, "size_mm", "mm", "cube root of the mean volume of a tetrahedron"),
    ROW(run_view, r.iterations, "iterations", NULL, "steps of Newton's method"),
    ROW(run_view, r.free_iterations, "free_iterations", NULL, "of them, without contact"),
    ROW(run_view, r.contact_iterations, "contact_iterations", NULL, "of them, with contact"),
    ROW(run_view, r.factorisations, "factorisations", NULL, "matrices that were factorised"),
    ROW(run_view, r.loads, "loads", NULL, "loads that were solved"),
    ROW(run_view, r.wall_s, "wall_s", "s", "wall time of the solve"),
    ROW(run_view, r.cpu_s, "cpu_s", "s", "its processor time"),
    ROW(run_view, r.prepare_s, "prepare_s", "s", "wall time to find an order of the unknowns"),
    ROW(run_view, r.assemble_s, "assemble_s", "s", "wall time of forces and matrices"),
    ROW(run_view, r.factor_s, "factor_s", "s", "wall time of factors"),
    ROW(run_view, r.solve_s, "solve_s", "s", "wall time of linear systems"),
    ROW(run_view, meshing_s, "meshing_s", "s", "wall time to mesh, once per mesh"),
    ROW(run_view, r.peak_mb, "peak_MB", "MB", "most memory that the process held"),
    ROW(run_view, r.residual_mn, "residual_mN", "mN", "norm of the forces that are left"),
    ROW(run_view, r.initial_mn, "initial_residual_mN", "mN", "the same with the bones moved and the tissue not"),
    ROW(run_view, r.min_j, "min_J", NULL, "smallest volume ratio of a tetrahedron"),
    ROW(run_view, r.inverted, "inverted_tets", NULL, "tetrahedra turned inside out"),
    ROW(run_view, error.mean_mm, "mean_error_mm", "mm", "mean distance of the moved skin from the reference's"),
    ROW(run_view, error.p95_mm, "p95_error_mm", "mm", "distance that 95 % do not exceed"),
    ROW(run_view, error.max_mm, "max_error_mm", "mm", "largest distance"),
    ROW(run_view, change.mean_mm, "mean_change_mm", "mm", "mean distance from the case's own settings, same mesh"),
    ROW(run_view, change.max_mm, "max_change_mm", "mm", "largest of those"),
};
static const record_table run_table = {.title = "A way to compute the prediction", RECORD_ROWS(run_row)};

static const record_row tube_row[] = {
    ROW(study_tube, cells, "cells", NULL, "cells through its wall"),
    ROW(study_tube, average, "averaged", NULL, "volume changes are averaged"),
    ROW(study_tube, poisson, "poisson", NULL, "Poisson's ratio"),
    ROW(study_tube, unknowns, "unknowns", NULL, "numbers solved for"),
    ROW(study_tube, iterations, "iterations", NULL, "steps of Newton's method"),
    ROW(study_tube, wall_s, "wall_s", "s", "wall time of the solve"),
    ROW(study_tube, error_mm, "error_mm", "mm", "root mean square error of the nodes"),
};
static const record_table tube_table = {.title = "A tube with an exact answer", RECORD_ROWS(tube_row)};

typedef struct study_view {
    const study_table *of;
    const char *case_name, *plan, *reference;
} study_view;

static const void *next_run(const void *of, int *i, const char **key, void *space)
{
    const study_table *t = ((const study_view *)of)->of;
    run_view *v = space;
    _Static_assert(sizeof *v <= RECORD_SPACE, "a run fits");
    (void)key;
    if (*i == t->count) return NULL;
    *v = (run_view){.group = study_group_name(study_rungs[*i].group),
                    .setting = study_rungs[*i].name,
                    .r = t->run[*i].result,
                    .error = t->error[*i],
                    .change = t->change[*i],
                    .front = t->best[*i]};
    v->meshing_s = v->r.meshing_s > 0 ? v->r.meshing_s : (double)NAN;
    return v;
}

static const void *next_tube(const void *of, int *i, const char **key, void *space)
{
    (void)key, (void)space;
    return *i < STUDY_TUBES ? &((const study_view *)of)->of->tube[*i] : NULL;
}

#define OF_TABLE(function, member)                                                                                     \
    static double function(const void *of) { return ((const study_view *)of)->of->member; }
OF_TABLE(reference_error, reference_error_mm)
OF_TABLE(order, order)
OF_TABLE(plain_slope, plain_slope)
OF_TABLE(average_slope, average_slope)

static const record_row study_row[] = {
    ROW(study_view, case_name, "case", NULL, "name of the case"),
    ROW(study_view, plan, "plan", NULL, "name of the plan"),
    ROW(study_view, reference, "reference", NULL, "the setting with which all are compared"),
    ROW_LIST(next_run, &run_table, "runs", "every setting"),
    ROW_LIST(next_tube, &tube_table, "tubes", "the same solver on a question with an exact answer"),
    ROW_FOUND(NUMBER, reference_error, "reference_error_mm", "mm", "how far the reference itself is off in the mean"),
    ROW_FOUND(NUMBER, order, "order", NULL, "of convergence of one mesh, halved and halved twice"),
    ROW_FOUND(NUMBER, plain_slope, "plain_slope", NULL, "power of size by which the error falls over meshes made anew"),
    ROW_FOUND(NUMBER, average_slope, "average_slope", NULL, "the same with averaged volumes"),
};
const record_table study_record_table = {
    .kind = "study", .title = "Record of gnathos study, study.json", RECORD_ROWS(study_row)};

json_t *study_json(const study_table *t)
{
    const study_view v = {.of = t,
                          .case_name = t->task->patient->name,
                          .plan = t->plan_name,
                          .reference = study_rungs[study_reference].name};
    return record_json(&study_record_table, &v);
}

static const record_row folder_row[] = {
    {.kind = RECORD_TEXT,
     .offset = 0,
     .name = "holds",
     .words = "study",
     .help = "what the folder holds, begun or done"},
};
const record_table study_folder_table = {
    .kind = "manifest", .title = "Mark of a folder that a study goes on in, manifest.json", RECORD_ROWS(folder_row)};

json_t *study_folder_json(void)
{
    const char *holds = "study";
    return record_json(&study_folder_table, &holds);
}
