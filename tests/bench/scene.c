/* What leaving tissue out saves and costs, on a plate. Prints CSV.
 *   scene [cells through the thickness, default 3]
 * tolerance 0 is the full solve; error_mm is what the scene says, true_mm the largest difference to the full
 * solve; ratio is total_s over that of the full solve. */
#include "geometry/mem.h"
#include "sim/scene.h"
#include "geometry/clock.h"
#include "tests/physics/block.h"
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    int cells = argc > 1 ? atoi(argv[1]) : 3;
    static const double tolerance[] = {0, 0.01, 0.02, 0.05, 0.1, 0.2};
    if (cells < 1) return 2;
    attach_map a;
    tetmesh m = plate_mesh(20 * cells, 14 * cells, cells, &a);
    err e = {0};
    region_material table = {REGION_ANY, {0}};
    if (!material_make(MATERIAL_SNH_LOG, 15, 0.45, &table.material, &e)) return 1;
    equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
    rest_motions(p.motion);
    p.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 6});
    solve_params params = solve_params_default();
    double *full = NULL, full_s = 0;
    puts("nodes,tets,tolerance_mm,left_out_nodes,left_out_tets,rounds,iterations,error_mm,true_mm,estimate_s,"
         "check_s,total_s,"
         "ratio");
    for (size_t i = 0; i < sizeof tolerance / sizeof *tolerance; i++) {
        scene_params scene = scene_params_default();
        scene.full = i == 0;
        scene.tolerance_mm = tolerance[i];
        scene_report r;
        equilibrium q;
        double begin = clock_s(), apart = 0;
        if (!scene_solve(&p, &scene, &params, &q, &r, &e) || q.outcome != SOLVED) return 1;
        double total = clock_s() - begin;
        if (i == 0) {
            full = COPY_ARRAY(double, q.xyz, 3 * (size_t)m.vertex_count);
            full_s = total;
        }
        for (size_t k = 0; k < 3 * (size_t)m.vertex_count; k += 3)
            apart = fmax(apart, vec_distance(full + k, q.xyz + k));
        printf("%d,%d,%g,%d,%d,%d,%d,%.4f,%.4f,%.3f,%.3f,%.3f,%.3f\n", m.vertex_count, m.tet_count, tolerance[i],
               r.left_out_nodes, r.left_out_tets, r.rounds, q.iterations, r.error_mm, apart, r.estimate_s, r.check_s,
               total, total / full_s);
        equilibrium_free(&q);
        scene_report_free(&r);
    }
    free(full);
    tetmesh_free(&m);
    attach_map_free(&a);
    return 0;
}
