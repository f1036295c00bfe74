/* The curved slab side by side with CalculiX (program ccx): same mesh, energy (nhiso) and boundary, both from
 * nothing. Prints CSV.
 *   calculix FOLDER [cells through the thickness, default 5] [threads, default 1]
 * 5 cells: 4.8k nodes; 7: 12k; 10: 34k. The deck and CalculiX's output are left in FOLDER.
 * largest_difference_mm holds the six digits that CalculiX prints and its own tolerance. */
#include "tests/bench/ccx.h"
#include "geometry/parallel.h"
#include "tests/physics/block.h"

static void write_deck(const ccx_job *job, const tetmesh *m, const attach_map *a, const material *law,
                       const double move[3])
{
    FILE *f = ccx_begin(job, m, law);
    ccx_step(f);
    fprintf(f, "*BOUNDARY\n");
    for (int32_t v = 0; v < m->vertex_count; v++)
        for (int c = 0; c < 3 && a->kind[v] == NODE_TIED; c++)
            fprintf(f, "%d,%d,%d,%.12g\n", v + 1, c + 1, c + 1, a->segment[v] == SEGMENT_MAXILLA ? move[c] : 0);
    ccx_end(f, NULL);
}

int main(int argc, char **argv)
{
    if (argc < 2) return 2;
    int cells = argc > 2 ? atoi(argv[2]) : 5, threads = argc > 3 ? atoi(argv[3]) : 1;
    if (cells < 1 || threads < 1) return 2;
    parallel_set_threads(threads);
    const ccx_job job = {argv[1], "slab"};
    static const double move[3] = {0, 2, 6};
    attach_map a;
    tetmesh m = slab_mesh(5 * cells, 6 * cells, cells, &a);
    puts("nodes,poisson,threads,outcome,iterations,wall_s,cpu_s,ccx_outcome,ccx_iterations,ccx_wall_s,ccx_"
         "cpu_s,"
         "ccx_over_gnathos_wall,ccx_over_gnathos_cpu,largest_difference_mm");
    for (int n = 0; n < 2; n++) {
        err e = {0};
        region_material table = {REGION_ANY, {0}};
        if (!material_make(MATERIAL_NH_ISO, 15, n ? 0.49 : 0.45, &table.material, &e)) give_up(&e);
        equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
        rest_motions(p.motion);
        p.motion[SEGMENT_MAXILLA] = rigid_translation(move);
        solve_params params = solve_params_default();
        params.blas_threads = threads;
        params.rel_tol = 1e-10; /* so that differences are CalculiX's */
        equilibrium q;
        spent begin = time_now(), ours, theirs = {0};
        if (!equilibrium_solve(&p, &params, &q, &e)) give_up(&e);
        ours = time_since(begin);
        write_deck(&job, &m, &a, &table.material, move);
        bool ended = ccx_run(&job, threads, &theirs);
        int iterations = ended ? ccx_iterations(&job) : 0;
        double worst = ended ? ccx_difference(&job, &m, q.xyz) : -1;
        printf("%d,%.2f,%d,%s,%d,%.2f,%.2f,%s,%d,%.2f,%.2f,%.1f,%.1f,%.2g\n", m.vertex_count, n ? 0.49 : 0.45, threads,
               solve_outcome_text(q.outcome), q.iterations, ours.wall_s, ours.cpu_s,
               ended && worst >= 0 ? "solved" : "stopped", iterations, theirs.wall_s, theirs.cpu_s,
               theirs.wall_s / ours.wall_s, theirs.cpu_s / ours.cpu_s, worst);
        fflush(stdout);
        equilibrium_free(&q);
    }
    tetmesh_free(&m);
    attach_map_free(&a);
    return 0;
}
