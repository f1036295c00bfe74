/* Time of whole solves of the curved slab against one linear solve in the same run. Prints CSV.
 *   slab [cells through the thickness, default 10] [threads, default 1] [repeats, default 3]
 * 5 cells: 4.8k nodes; 10: 34k. Ways: cold (everything from nothing), replan (the patch is moved 1 mm
 * further, from the solution before), both to 1e-6; cold-1e-8, the default tolerance; factor (cold, by
 * Cholesky factors alone). The ratio of wall times is what a user sees; on a busy machine that of CPU times
 * with one thread is the one to trust. */
#include "tests/bench/yardstick.h"
#include "geometry/parallel.h"
#include "tests/physics/block.h"
#include <string.h>

enum { COLD, REPLAN, COLD_TIGHT, FACTOR, WAYS };
static const char *const way_name[WAYS] = {"cold", "replan", "cold-1e-8", "factor"};

typedef struct run {
    spent took, linear;
    equilibrium q;
} run;

static equilibrium solve(solver *t, const rigid *motion, const double *start, const solve_params *params)
{
    err e = {0};
    equilibrium q;
    if (!solver_solve(t, motion, start, params, &q, &e)) give_up(&e);
    return q;
}

static run measure(const equilibrium_problem *p, int way, int threads)
{
    err e = {0};
    run r = {.linear = one_linear_solve(p, threads)};
    solve_params params = solve_params_default();
    params.rel_tol = way == COLD_TIGHT ? 1e-8 : 1e-6;
    params.blas_threads = threads;
    if (way == FACTOR) params.linear = LINEAR_FACTOR;
    solver *t = NULL;
    spent begin = time_now();
    if (!solver_create(p, threads, &t, &e)) give_up(&e);
    r.q = solve(t, p->motion, NULL, &params);
    if (way == REPLAN) {
        equilibrium before = r.q;
        rigid motion[SEGMENT_COUNT];
        memcpy(motion, p->motion, sizeof motion);
        motion[SEGMENT_MAXILLA].t[2] += 1;
        begin = time_now();
        r.q = solve(t, motion, before.xyz, &params);
        equilibrium_free(&before);
    }
    r.took = time_since(begin);
    solver_destroy(&t);
    return r;
}

static int by_value(const void *p, const void *q)
{
    double a = *(const double *)p, b = *(const double *)q;
    return (a > b) - (a < b);
}

int main(int argc, char **argv)
{
    int cells = argc > 1 ? atoi(argv[1]) : 10, threads = argc > 2 ? atoi(argv[2]) : 1;
    int repeats = argc > 3 ? atoi(argv[3]) : 3;
    if (cells < 1 || threads < 1 || repeats < 1) return 2;
    parallel_set_threads(threads);
    attach_map a;
    tetmesh m = slab_mesh(5 * cells, 6 * cells, cells, &a);
    err e = {0};
    double *wall = NEW_ARRAY(double, repeats), *cpu = NEW_ARRAY(double, repeats);
    puts("nodes,tets,unknowns,poisson,threads,way,outcome,iterations,cg,preconditioners,factorisations,min_j,"
         "wall_s,cpu_s,linear_wall_s,linear_cpu_s,wall_ratio_min,wall_ratio,wall_ratio_max,cpu_ratio_min,cpu_"
         "ratio,"
         "cpu_ratio_max");
    for (int n = 0; n < 2; n++)
        for (int way = 0; way < WAYS; way++) {
            region_material table = {REGION_ANY, {0}};
            if (!material_make(MATERIAL_SNH_LOG, 15, n ? 0.49 : 0.45, &table.material, &e)) give_up(&e);
            equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
            rest_motions(p.motion);
            p.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 6});
            run r = {0};
            for (int k = 0; k < repeats; k++) {
                equilibrium_free(&r.q);
                r = measure(&p, way, threads);
                wall[k] = r.took.wall_s / r.linear.wall_s;
                cpu[k] = r.took.cpu_s / r.linear.cpu_s;
            }
            qsort(wall, (size_t)repeats, sizeof *wall, by_value);
            qsort(cpu, (size_t)repeats, sizeof *cpu, by_value);
            printf("%d,%d,%lld,%.2f,%d,%s,%s,%d,%d,%d,%d,%.4f,%.2f,%.2f,%.2f,%.2f,%.3f,%.3f,%.3f,%.3f,%.3f,%."
                   "3f\n",
                   m.vertex_count, m.tet_count, (long long)r.q.unknown_count, n ? 0.49 : 0.45, threads, way_name[way],
                   solve_outcome_text(r.q.outcome), r.q.iterations, r.q.cg_iterations, r.q.preconditioners,
                   r.q.factorisations, r.q.extremes.min_j, r.took.wall_s, r.took.cpu_s, r.linear.wall_s, r.linear.cpu_s,
                   wall[0], wall[repeats / 2], wall[repeats - 1], cpu[0], cpu[repeats / 2], cpu[repeats - 1]);
            fflush(stdout);
            equilibrium_free(&r.q);
        }
    free(wall);
    free(cpu);
    tetmesh_free(&m);
    attach_map_free(&a);
    return 0;
}
