/* What a plan costs on a prepared case, in linear solves (see yardstick.h) of the same tissue. Prints CSV.
 *   head CASE PLAN [threads, default 1] [WAY...]
 * Ways: off (no contact), bones (predict's default), each cold, and bones-replan, after bones: every moved segment 1 mm
 * further, from the solution before, as a live prediction goes on. Named alone: lips, cold. All tissue is solved for,
 * to 1e-6; the prepared case's bones are made ready beforehand. */
#include "app/planner/predict/prediction.h"
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
    prediction_options asked;
    int threads;
} work;

static void tell(const work *w, const char *way, const equilibrium *q, spent took, spent one)
{
    printf("%d,%d,%lld,%s,%s,%d,%d,%d,%d,%.3f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f\n", w->p.tissue.mesh.vertex_count,
           w->p.tissue.mesh.tet_count, (long long)q->unknown_count, way, solve_outcome_text(q->outcome), q->iterations,
           q->factorisations, q->cg_iterations, q->contact.active_nodes, q->contact.depth_mm, took.wall_s, took.cpu_s,
           one.wall_s, one.cpu_s, took.wall_s / one.wall_s, took.cpu_s / one.cpu_s);
    fflush(stdout);
}

static void run(work *w, contact_kind kind)
{
    static const char *const name[] = {[CONTACT_OFF] = "off", [CONTACT_BONES] = "bones", [CONTACT_LIPS] = "lips"};
    err e = {0};
    equilibrium next;
    prediction made;
    prediction_setup setup;
    solver *t = NULL;
    w->asked.contact = kind;
    spent begin = time_now();
    if (!prediction_begin(&w->c, &w->p, &w->bones, &w->moves, &w->asked, NULL, &made, &setup, &e)) give_up(&e);
    spent ready = time_since(begin);
    equilibrium_problem plain = setup.problem; /* the yardstick touches nothing */
    plain.contact = NULL;
    spent one = one_linear_solve(&plain, w->threads);
    setup.params.blas_threads = w->threads;
    begin = time_now();
    if (!solver_create(&setup.problem, w->threads, &t, &e) ||
        !solver_solve(t, setup.problem.motion, NULL, &setup.params, &made.solve, &e))
        give_up(&e);
    spent took = time_since(begin);
    took = (spent){took.wall_s + ready.wall_s, took.cpu_s + ready.cpu_s};
    tell(w, name[kind], &made.solve, took, one);
    if (kind == CONTACT_BONES && made.solve.outcome == SOLVED) {
        rigid from[SEGMENT_COUNT];
        memcpy(from, setup.problem.motion, sizeof from);
        for (int s = 0; s < SEGMENT_COUNT; s++) {
            double length = vec_norm(setup.problem.motion[s].t);
            if (length > 0) vec_scale(setup.problem.motion[s].t, 1 + 1 / length, setup.problem.motion[s].t);
        }
        begin = time_now();
        if (!solver_follow(t, from, setup.problem.motion, made.solve.xyz, &setup.params, &next, &e)) give_up(&e);
        tell(w, "bones-replan", &next, time_since(begin), one);
        equilibrium_free(&next);
    }
    solver_destroy(&t);
    prediction_setup_free(&setup);
    prediction_free(&made);
}

int main(int argc, char **argv)
{
    err e = {0};
    static work w;
    w.threads = argc > 3 ? atoi(argv[3]) : 1;
    if (argc < 3 || w.threads < 1) return 2;
    parallel_set_threads(w.threads);
    if (!case_file_load(argv[1], &w.c, &e) || !prepared_get(&w.c, NULL, NULL, &w.p, &e) ||
        !plan_moves_load(argv[2], &w.c, &w.p.points, &w.plan, &w.moves, &e) || !bone_shapes_make(&w.p, &w.bones, &e))
        give_up(&e);
    w.asked = prediction_options_default();
    w.asked.rel_tol = 1e-6;
    w.asked.load_steps = w.plan.load_steps;
    puts("nodes,tets,unknowns,way,outcome,iterations,factorisations,cg,touching,depth_mm,wall_s,cpu_s,linear_wall_s,"
         "linear_cpu_s,wall_ratio,cpu_ratio");
    static char *usual[] = {"off", "bones"};
    char **way = argc > 4 ? argv + 4 : usual;
    for (int k = 0; k < (argc > 4 ? argc - 4 : 2); k++) {
        contact_kind kind;
        if (!contact_kind_find(way[k], &kind)) return 2;
        run(&w, kind);
    }
    bone_shapes_free(&w.bones);
    prepared_free(&w.p);
    return 0;
}
