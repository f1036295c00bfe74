/* Error against time of linear tets with and without averaged volume changes. Prints CSV.
 *   elements [finest level of the slab: 12 or 6, default 12] [threads, default 1] [Poisson's ratio ...]
 * manufactured: L2 error of a known large deformation of a cube. slab: the curved slab with its patch moved
 * by 6 mm, largest and root mean square error of the displacement of the outer (skin) nodes that all meshes
 * share, against averaged tets on the finest mesh. */
#include "tests/bench/yardstick.h"
#include "geometry/parallel.h"
#include "tests/physics/manufactured.h"

typedef struct skin {
    int32_t count;
    double *u; /* of the nodes of the coarsest mesh on the outer side */
} skin;

enum { COARSEST = 3 };

static skin solve_slab(int cells, double poisson, element_kind kind, equilibrium *q, spent *took)
{
    err e = {0};
    attach_map a;
    tetmesh m = slab_mesh(5 * cells, 6 * cells, cells, &a);
    region_material table = {REGION_ANY, {0}};
    if (!material_make(MATERIAL_SNH_LOG, 15, poisson, &table.material, &e) ||
        !element_choose(&table.material, kind, &e))
        give_up(&e);
    equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
    rest_motions(p.motion);
    p.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 6});
    solve_params params = solve_params_default();
    params.rel_tol = 1e-6;
    spent begin = time_now();
    if (!equilibrium_solve(&p, &params, q, &e)) give_up(&e);
    *took = time_since(begin);
    int nx = 5 * COARSEST, ny = 6 * COARSEST, step = cells / COARSEST;
    skin s = {0, NEW_ARRAY(double, 3 * (size_t)((nx + 1) * (ny + 1)))};
    block grid = {5 * cells, 6 * cells, cells, {0}, 6, 0};
    for (int j = 0; j <= ny; j++)
        for (int i = 0; i <= nx; i++, s.count++) {
            size_t v = (size_t)block_node(&grid, i * step, j * step, cells);
            vec_sub(q->xyz + 3 * v, m.xyz + 3 * v, s.u + 3 * (size_t)s.count);
        }
    tetmesh_free(&m);
    attach_map_free(&a);
    return s;
}

static const char *const name[] = {[ELEMENT_LINEAR] = "linear", [ELEMENT_AVERAGED] = "averaged"};

static void manufactured_rows(double poisson)
{
    for (int kind = ELEMENT_LINEAR; kind <= ELEMENT_AVERAGED; kind++)
        for (int cells = 4; cells <= 16; cells *= 2) {
            int iterations;
            spent begin = time_now();
            double error = manufactured_error(cells, poisson, (element_kind)kind, &iterations);
            spent took = time_since(begin);
            printf("manufactured,%g,%s,%d,%d,solved,%d,%.2f,%.2f,,%.5f\n", poisson, name[kind], cells,
                   3 * (cells - 1) * (cells - 1) * (cells - 1), iterations, took.wall_s, took.cpu_s, error);
            fflush(stdout);
        }
}

static void slab_rows(double poisson, int finest)
{
    equilibrium q;
    spent took;
    skin want = solve_slab(finest, poisson, ELEMENT_AVERAGED, &q, &took);
    for (int kind = ELEMENT_LINEAR; kind <= ELEMENT_AVERAGED; kind++)
        for (int cells = COARSEST; cells <= finest; cells *= 2) {
            if (cells == finest && kind == ELEMENT_AVERAGED) continue;
            equilibrium_free(&q);
            skin got = solve_slab(cells, poisson, (element_kind)kind, &q, &took);
            double worst = 0, square = 0;
            for (int32_t i = 0; i < got.count; i++) {
                double d = vec_distance(got.u + 3 * (size_t)i, want.u + 3 * (size_t)i);
                worst = fmax(worst, d);
                square += d * d / got.count;
            }
            printf("slab,%g,%s,%d,%lld,%s,%d,%.2f,%.2f,%.5f,%.5f\n", poisson, name[kind], cells,
                   (long long)q.unknown_count, solve_outcome_text(q.outcome), q.iterations, took.wall_s, took.cpu_s,
                   worst, sqrt(square));
            fflush(stdout);
            free(got.u);
        }
    equilibrium_free(&q);
    free(want.u);
}

int main(int argc, char **argv)
{
    int finest = argc > 1 ? atoi(argv[1]) : 12, threads = argc > 2 ? atoi(argv[2]) : 1;
    if ((finest != 6 && finest != 12) || threads < 1) return 2;
    parallel_set_threads(threads);
    puts("body,poisson,element,cells,unknowns,outcome,iterations,wall_s,cpu_s,largest_error_mm,rms_error_mm");
    static const char *const usual[] = {"0.45", "0.47", "0.48", "0.49", "0.499"};
    const char *const *poisson = argc > 3 ? (const char *const *)argv + 3 : usual;
    for (int n = 0, count = argc > 3 ? argc - 3 : 5; n < count; n++) {
        manufactured_rows(atof(poisson[n]));
        slab_rows(atof(poisson[n]), finest);
    }
    return 0;
}
