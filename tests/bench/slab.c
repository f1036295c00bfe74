/* Time of a whole solve against one linear solve of the same matrix. Prints CSV.
 *   slab [cells through the thickness, default 5] [model, default snhlog] [move of the patch outward, mm,
 * default 6] 5 cells: 4.8k nodes; 10 cells: 34k. linear_s is one ordering, assembly, factorisation and solve
 * of the linear-elastic matrix; ratio is total_s / linear_s. */
#include "geometry/mem.h"
#include "sim/src/clock.h"
#include "sim/src/descent.h"
#include "tests/physics/block.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double one_linear_solve(const equilibrium_problem *p, err *e)
{
    solver *t = NULL;
    bool positive;
    double begin = clock_s();
    if (!solver_create(p, 1, &t, e)) return -1;
    if (!solver_order(t, e)) return -1;
    double *b = NEW_ARRAY(double, t->b.unknown_count);
    for (int32_t i = 0; i < t->b.unknown_count; i++) b[i] = 1;
    assembly_stiffness(&t->a, p->mesh->xyz, PROJECTION_NONE);
    assembly_matrix(&t->a, &t->b);
    if (!linear_factor(t->l, t->a.value, 0, &positive, e) || !positive || !linear_solve(t->l, b, b, e))
        return -1;
    double seconds = clock_s() - begin;
    linear_stats s = linear_measure(t->l);
    fprintf(stderr,
            "prepare %.3f s (ordering %.3f), factorise %.3f s, solve %.4f s, %.2f GFLOP, nnz(L) %.1f M\n",
            t->prepare_s, s.analyse_s, s.factor_s, s.solve_s, s.factor_flops * 1e-9,
            (double)s.factor_entries * 1e-6);
    free(b);
    solver_destroy(&t);
    return seconds;
}

static void show(const newton_record *r, void *context)
{
    (void)context;
    static const char *const kind[] = {"true", "reused", "blended", "projected", "shifted"};
    fprintf(stderr, "  load %.3f it %2d residual %.3e energy %.9g step %g %s min J %.3f\n", r->load,
            r->iteration, r->residual_mn, r->energy_uj, r->step, kind[r->hessian], r->min_j);
}

int main(int argc, char **argv)
{
    int cells = argc > 1 ? atoi(argv[1]) : 5;
    int model = material_model_from_name(argc > 2 ? argv[2] : "snhlog");
    double move[3] = {0, 2, argc > 3 ? atof(argv[3]) : 6};
    if (cells < 1 || model < 0) return 2;
    attach_map a;
    tetmesh m = slab_mesh(5 * cells, 6 * cells, cells, &a);
    err e = {0};
    puts("nodes,tets,unknowns,poisson,way,outcome,iterations,factorisations,min_j,total_s,factor_s,solve_s,"
         "assemble_s,"
         "linear_s,ratio,factor_entries,gflop,cholmod_mb");
    for (int n = 0; n < 2; n++) {
        region_material table = {REGION_ANY, {0}};
        if (!material_make((material_model)model, 15, n ? 0.49 : 0.45, &table.material, &e)) return 1;
        equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
        rest_motions(p.motion);
        p.motion[SEGMENT_MAXILLA] = rigid_translation(move);
        double linear_s = one_linear_solve(&p, &e);
        for (int reuse = 1; reuse >= 0; reuse--) {
            solve_params params = solve_params_default();
            params.reuse_factor = reuse;
            params.progress = show;
            equilibrium q;
            if (!equilibrium_solve(&p, &params, &q, &e)) {
                fprintf(stderr, "%s\n", e.text);
                return 1;
            }
            printf("%d,%d,%lld,%.2f,%s,%s,%d,%d,%.4f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%lld,%.2f,%.0f\n",
                   m.vertex_count, m.tet_count, (long long)q.unknown_count, n ? 0.49 : 0.45,
                   reuse ? "reuse" : "newton", solve_outcome_text(q.outcome), q.iterations, q.factorisations,
                   q.extremes.min_j, q.total_s, q.factor_s, q.solve_s, q.assemble_s, linear_s,
                   q.total_s / linear_s, (long long)q.factor_entries, q.factor_flops * 1e-9,
                   q.memory_peak_mb);
            fflush(stdout);
            equilibrium_free(&q);
        }
    }
    tetmesh_free(&m);
    attach_map_free(&a);
    return 0;
}
