#include "sim/scene.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "geometry/clock.h"
#include "sim/src/scene/scene_part.h"
#include <stdlib.h>
#include <string.h>

scene_params scene_params_default(void) { return (scene_params){.tolerance_mm = 0.05, .max_rounds = 3}; }

void scene_report_free(scene_report *r)
{
    free(r->error);
    *r = (scene_report){0};
}

static bool check_params(const scene_params *p, err *e)
{
    if (p->full) return true;
    if (!(p->tolerance_mm > 0)) return err_set(e, ERR_INPUT, "scene tolerance_mm must be > 0, got %g", p->tolerance_mm);
    if (p->max_rounds < 1) return err_set(e, ERR_INPUT, "scene max_rounds must be >= 1, got %d", p->max_rounds);
    return true;
}

/* What was asked of the held nodes takes the place of what was expected of them. */
static void learn(const equilibrium_problem *problem, const scene_part *p, scene_report *r, double *estimate, double *x)
{
    r->error_mm = 0;
    for (size_t v = 0; v < (size_t)problem->mesh->vertex_count; v++) {
        double size = vec_norm(r->error + 3 * v);
        r->error_mm = fmax(r->error_mm, size);
        if (p->held[v]) estimate[v] = size;
        vec_add(x + 3 * v, r->error + 3 * v, x + 3 * v);
    }
}

/* What the rounds before cost is part of the last one's record. */
static void carry_cost(const equilibrium *before, equilibrium *after)
{
    int32_t count = before->record_count + after->record_count;
    solve_record *record = NEW_ARRAY(solve_record, count);
    for (int32_t i = 0; i < count; i++)
        record[i] = i < before->record_count ? before->record[i] : after->record[i - before->record_count];
    free(after->record);
    after->record = record;
    after->record_count = count;
    after->iterations += before->iterations;
    after->factorisations += before->factorisations;
    after->cg_iterations += before->cg_iterations;
    after->preconditioners += before->preconditioners;
    after->loads += before->loads;
    after->halvings += before->halvings;
    after->prepare_s += before->prepare_s;
    after->assemble_s += before->assemble_s;
    after->factor_s += before->factor_s;
    after->solve_s += before->solve_s;
    after->total_s += before->total_s;
    after->memory_peak_mb = fmax(after->memory_peak_mb, before->memory_peak_mb);
}

static bool solve_whole(const equilibrium_problem *problem, const double *from, const solve_params *params,
                        scene_report *r, equilibrium *out, err *e)
{
    equilibrium_problem whole = *problem;
    whole.start_xyz = from;
    memset(r->error, 0, 3 * (size_t)r->nodes * sizeof *r->error);
    r->left_out_nodes = r->left_out_tets = 0;
    r->error_mm = r->left_out_mm3 = 0;
    return equilibrium_solve(&whole, params, out, e);
}

/* Where it is solved, the held nodes are asked: estimate[nodes] learns of their answer, and start[3*nodes] is where it
 * leads to. */
static bool solve_part(const equilibrium_problem *problem, const scene_part *p, const double *from,
                       const solve_params *params, double *estimate, double *start, scene_report *r, equilibrium *out,
                       err *e)
{
    r->left_out_nodes = r->nodes - p->mesh.vertex_count;
    r->left_out_tets = r->tets - p->mesh.tet_count;
    r->left_out_mm3 = tetmesh_measure(problem->mesh).volume_mm3 - tetmesh_measure(&p->mesh).volume_mm3;
    if (!scene_part_solve(problem, p, from, params, out, e)) return false;
    if (out->outcome != SOLVED) return true;
    double begin = clock_s();
    if (!scene_check(problem, p->held, out->xyz, r->error, e)) return false;
    r->check_s += clock_s() - begin;
    memcpy(start, out->xyz, 3 * (size_t)r->nodes * sizeof *start);
    learn(problem, p, r, estimate, start);
    return true;
}

/* Until what is left out is small enough; *q is of the last round, with the cost of all. */
static bool solve_rounds(const equilibrium_problem *problem, const scene_params *scene, const solve_params *params,
                         double *estimate, double *start, scene_report *r, equilibrium *q, err *e)
{
    const double *from = problem->start_xyz;
    bool ok = true;
    for (bool done = false; ok && !done;) {
        scene_part p;
        equilibrium next = {0};
        r->rounds++;
        scene_part_make(problem, estimate, r->rounds == 1 ? scene->tolerance_mm : scene->tolerance_mm / 2, &p);
        r->full = scene->full || p.held_count == 0 || p.mesh.tet_count == 0 ||
                  (r->rounds > 1 && r->rounds == scene->max_rounds);
        ok = r->full ? solve_whole(problem, from, params, r, &next, e)
                     : solve_part(problem, &p, from, params, estimate, start, r, &next, e);
        done =
            r->full || next.outcome != SOLVED || r->error_mm <= scene->tolerance_mm || r->rounds == scene->max_rounds;
        from = start;
        scene_part_free(&p);
        if (ok) carry_cost(q, &next);
        equilibrium_free(q);
        *q = next;
    }
    return ok;
}

bool scene_solve(const equilibrium_problem *problem, const scene_params *scene, const solve_params *params,
                 equilibrium *out, scene_report *report, err *e)
{
    if (!check_params(scene, e)) return false;
    size_t n = (size_t)problem->mesh->vertex_count;
    scene_params whole = *scene;
    whole.full |= problem->targets != NULL; /* what they draw is not expected to stay */
    scene_report r = {.full = whole.full,
                      .tolerance_mm = scene->tolerance_mm,
                      .nodes = problem->mesh->vertex_count,
                      .tets = problem->mesh->tet_count,
                      .error = NEW_ARRAY(double, 3 * n)};
    double *estimate = NEW_ARRAY(double, n), *start = NEW_ARRAY(double, 3 * n), begin = clock_s();
    if (!r.full) scene_estimate(problem->mesh, problem->attach, problem->motion, estimate);
    r.estimate_s = clock_s() - begin;
    equilibrium q = {0};
    bool ok = solve_rounds(problem, &whole, params, estimate, start, &r, &q, e);
    free(estimate);
    free(start);
    if (ok) {
        *out = q;
        *report = r;
    } else {
        equilibrium_free(&q);
        scene_report_free(&r);
    }
    return ok;
}
