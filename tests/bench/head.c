/* What a plan costs on a prepared case, in linear solves (see yardstick.h) of the same tissue. Prints CSV.
 *   head CASE PLAN [threads, default 1]
 * Ways: off (no contact), bones (predict's default), each cold, and bones-replan: every moved segment 1 mm further,
 * from the solution before. All tissue is solved for, to 1e-6; the prepared case's bones are made ready beforehand. */
#include "app/planner/predict/plan_contact.h"
#include "app/planner/plan/plan_file.h"
#include "app/planner/plan/plan_moves.h"
#include "app/planner/predict/plan_tissue.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "tests/bench/yardstick.h"
#include <string.h>

typedef struct work {
    case_file c;
    prepared p;
    plan_file plan;
    plan_moves moves;
    bone_shapes bones;
    plan_tissue flesh;
    solve_params params;
} work;

static void tell(const work *w, const char *way, const equilibrium *q, spent took, spent one)
{
    printf("%d,%d,%lld,%s,%s,%d,%d,%d,%d,%.3f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f\n", w->p.tissue.mesh.vertex_count,
           w->p.tissue.mesh.tet_count, (long long)q->unknown_count, way, solve_outcome_text(q->outcome), q->iterations,
           q->factorisations, q->cg_iterations, q->contact.active_nodes, q->contact.depth_mm, took.wall_s, took.cpu_s,
           one.wall_s, one.cpu_s, took.wall_s / one.wall_s, took.cpu_s / one.cpu_s);
    fflush(stdout);
}

static void run(work *w, contact_kind kind, bool again)
{
    err e = {0};
    equilibrium q, next;
    plan_contact touch = {0};
    solver *t = NULL;
    equilibrium_problem problem = {.mesh = &w->flesh.mesh,
                                   .attach = &w->flesh.attach,
                                   .materials = w->flesh.material,
                                   .material_count = w->flesh.material_count};
    memcpy(problem.motion, w->moves.move, sizeof problem.motion);
    spent one = one_linear_solve(&problem, w->params.blas_threads), begin = time_now();
    if (kind != CONTACT_OFF) {
        plan_contact_make(kind, &w->p.tissue, &w->bones, &w->flesh.attach, w->moves.move, w->c.material.young_kpa,
                          &touch);
        problem.contact = &touch.setup;
    }
    if (!solver_create(&problem, w->params.blas_threads, &t, &e) ||
        !solver_solve(t, problem.motion, NULL, &w->params, &q, &e))
        give_up(&e);
    tell(w, kind == CONTACT_OFF ? "off" : "bones", &q, time_since(begin), one);
    if (again && q.outcome == SOLVED) {
        for (int s = 0; s < SEGMENT_COUNT; s++) {
            double length = vec_norm(problem.motion[s].t);
            if (length > 0) vec_scale(problem.motion[s].t, 1 + 1 / length, problem.motion[s].t);
        }
        begin = time_now();
        if (!solver_solve(t, problem.motion, q.xyz, &w->params, &next, &e)) give_up(&e);
        tell(w, "bones-replan", &next, time_since(begin), one);
        equilibrium_free(&next);
    }
    equilibrium_free(&q);
    solver_destroy(&t);
    plan_contact_free(&touch);
}

int main(int argc, char **argv)
{
    err e = {0};
    static work w;
    int threads = argc > 3 ? atoi(argv[3]) : 1;
    if (argc < 3 || threads < 1) return 2;
    parallel_set_threads(threads);
    w.params = solve_params_default();
    w.params.rel_tol = 1e-6;
    w.params.blas_threads = threads;
    if (!case_file_load(argv[1], &w.c, &e) || !prepared_get(&w.c, NULL, NULL, &w.p, &e) ||
        !plan_moves_load(argv[2], &w.c, &w.p.points, &w.plan, &w.moves, &e) || !bone_shapes_make(&w.p, &w.bones, &e) ||
        !plan_tissue_make(&w.c, &w.p, w.moves.move, false, &w.flesh, &e))
        give_up(&e);
    plan_contact_release(&w.p.tissue, &w.bones, w.moves.move, &w.flesh.attach);
    if (w.plan.load_steps > 0) w.params.load_steps = w.plan.load_steps;
    puts("nodes,tets,unknowns,way,outcome,iterations,factorisations,cg,touching,depth_mm,wall_s,cpu_s,linear_wall_s,"
         "linear_cpu_s,wall_ratio,cpu_ratio");
    run(&w, CONTACT_OFF, false);
    run(&w, CONTACT_BONES, true);
    plan_tissue_free(&w.flesh);
    bone_shapes_free(&w.bones);
    return 0;
}
