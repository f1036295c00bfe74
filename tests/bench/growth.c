/* How time and memory of a cold solve of the curved slab to 1e-6 grow with its size. Prints CSV.
 *   growth [threads, default 1] [most cells through the thickness, default 22: 1M unknowns] [Poisson's ratio ...]
 * Each size runs in a process of its own, so that its largest memory is its own; exponent: of time between
 * this size and the smallest one (1: in proportion). */
#include "tests/bench/yardstick.h"
#include "geometry/parallel.h"
#include "tests/physics/block.h"
#include <sys/wait.h>
#include <unistd.h>

typedef struct result {
    int64_t unknowns;
    int32_t nodes;
    int iterations, cg, factorisations, outcome;
    spent took;
} result;

static result run(int cells, double poisson, int threads)
{
    attach_map a;
    err e = {0};
    tetmesh m = slab_mesh(5 * cells, 6 * cells, cells, &a);
    region_material table = {REGION_ANY, {0}};
    if (!material_make(MATERIAL_SNH_LOG, 15, poisson, &table.material, &e)) give_up(&e);
    equilibrium_problem p = {.mesh = &m, .attach = &a, .materials = &table, .material_count = 1};
    rest_motions(p.motion);
    p.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 6});
    solve_params params = solve_params_default();
    params.rel_tol = 1e-6;
    params.blas_threads = threads;
    equilibrium q;
    spent begin = time_now();
    if (!equilibrium_solve(&p, &params, &q, &e)) give_up(&e);
    return (result){q.unknown_count,  m.vertex_count, q.iterations,     q.cg_iterations,
                    q.factorisations, (int)q.outcome, time_since(begin)};
}

int main(int argc, char **argv)
{
    static const int cells[] = {7, 10, 15, 22};
    int threads = argc > 1 ? atoi(argv[1]) : 1, most = argc > 2 ? atoi(argv[2]) : 22;
    if (threads < 1) return 2;
    parallel_set_threads(threads);
    puts("nodes,unknowns,poisson,threads,outcome,iterations,cg,factorisations,wall_s,cpu_s,peak_mb,wall_exponent,cpu_"
         "exponent");
    static char *usual[] = {"0.45", "0.49"};
    char **poisson = argc > 3 ? argv + 3 : usual;
    for (int n = 0; n < (argc > 3 ? argc - 3 : 2); n++) {
        double nu = atof(poisson[n]);
        result first = {0};
        for (size_t k = 0; k < sizeof cells / sizeof *cells && cells[k] <= most; k++) {
            int end[2], status;
            result r = {0};
            fflush(stdout);
            if (pipe(end) != 0) return 1;
            pid_t child = fork();
            if (child == 0) {
                r = run(cells[k], nu, threads);
                _exit(write(end[1], &r, sizeof r) == sizeof r ? 0 : 1);
            }
            close(end[1]);
            struct rusage used;
            bool ok = read(end[0], &r, sizeof r) == sizeof r;
            close(end[0]);
            if (wait4(child, &status, 0, &used) != child || !ok) return 1;
            if (k == 0) first = r;
            double more = log((double)r.unknowns / (double)first.unknowns);
            printf("%d,%lld,%.2f,%d,%s,%d,%d,%d,%.2f,%.2f,%.0f,%.2f,%.2f\n", r.nodes, (long long)r.unknowns, nu,
                   threads, solve_outcome_text((solve_outcome)r.outcome), r.iterations, r.cg, r.factorisations,
                   r.took.wall_s, r.took.cpu_s, (double)used.ru_maxrss / 1024,
                   k ? log(r.took.wall_s / first.took.wall_s) / more : 0,
                   k ? log(r.took.cpu_s / first.took.cpu_s) / more : 0);
        }
    }
    return 0;
}
