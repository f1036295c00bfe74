/* The curved slab side by side with CalculiX (program ccx): same mesh, energy (nhiso) and boundary, both from
 * nothing. Prints CSV.
 *   calculix FOLDER [cells through the thickness, default 5] [threads, default 1]
 * 5 cells: 4.8k nodes; 7: 12k; 10: 34k. The deck and CalculiX's output are left in FOLDER.
 * largest_difference_mm holds the six digits that CalculiX prints and its own tolerance. */
#include "tests/bench/yardstick.h"
#include "geometry/parallel.h"
#include "tests/physics/block.h"
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static FILE *open_file(const char *folder, const char *name, const char *mode)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, mode);
    if (!f) {
        fprintf(stderr, "%s: cannot be opened\n", path);
        exit(1);
    }
    return f;
}

static void write_deck(const char *folder, const tetmesh *m, const attach_map *a, const material *law,
                       const double move[3])
{
    FILE *f = open_file(folder, "slab.inp", "w");
    fprintf(f, "*NODE,NSET=NALL\n");
    for (int32_t v = 0; v < m->vertex_count; v++) {
        const double *x = m->xyz + 3 * (size_t)v;
        fprintf(f, "%d,%.12g,%.12g,%.12g\n", v + 1, x[0], x[1], x[2]);
    }
    fprintf(f, "*ELEMENT,TYPE=C3D4,ELSET=EALL\n");
    for (int32_t t = 0; t < m->tet_count; t++) {
        const int32_t *n = m->tet + 4 * (size_t)t;
        fprintf(f, "%d,%d,%d,%d,%d\n", t + 1, n[0] + 1, n[1] + 1, n[2] + 1, n[3] + 1);
    }
    fprintf(f,
            "*MATERIAL,NAME=TISSUE\n*HYPERELASTIC,NEO HOOKE\n%.14g,%.14g\n"
            "*SOLID SECTION,ELSET=EALL,MATERIAL=TISSUE\n*STEP,NLGEOM,INC=2000\n*STATIC\n1,1.\n"
            "*CONTROLS,PARAMETERS=FIELD\n1.e-8,1.e-6\n*BOUNDARY\n",
            law->mu_kpa / 2, 2 / law->lambda_kpa);
    for (int32_t v = 0; v < m->vertex_count; v++)
        for (int c = 0; c < 3 && a->kind[v] == NODE_TIED; c++)
            fprintf(f, "%d,%d,%d,%.12g\n", v + 1, c + 1, c + 1, a->segment[v] == SEGMENT_MAXILLA ? move[c] : 0);
    fprintf(f, "*NODE PRINT,NSET=NALL\nU\n*END STEP\n");
    fclose(f);
}

/* Wall and CPU seconds of ccx; false: it did not end well. */
static bool run_calculix(const char *folder, int threads, spent *took)
{
    int status;
    struct rusage used;
    fflush(stdout);
    double begin = clock_s();
    pid_t child = fork();
    if (child == 0) {
        char count[16];
        snprintf(count, sizeof count, "%d", threads);
        setenv("OMP_NUM_THREADS", count, 1);
        if (chdir(folder) == 0 && freopen("ccx.log", "w", stdout)) execlp("ccx", "ccx", "slab", (char *)NULL);
        _exit(127);
    }
    if (wait4(child, &status, 0, &used) != child) return false;
    *took = (spent){clock_s() - begin, (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                                           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec)};
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* Largest difference of displacements, -1: some are missing. iterations: from slab.sta. */
static double compare(const char *folder, const tetmesh *m, const double *xyz, int *iterations)
{
    FILE *f = open_file(folder, "slab.dat", "r");
    char line[256];
    double worst = 0;
    int32_t met = 0, node;
    while (fgets(line, sizeof line, f)) {
        double u[3];
        if (sscanf(line, "%d %lf %lf %lf", &node, u, u + 1, u + 2) != 4) continue;
        if (node < 1 || node > m->vertex_count) continue;
        met++;
        for (int c = 0; c < 3; c++) {
            size_t i = 3 * (size_t)(node - 1) + (size_t)c;
            worst = fmax(worst, fabs(xyz[i] - m->xyz[i] - u[c]));
        }
    }
    fclose(f);
    f = open_file(folder, "slab.sta", "r");
    *iterations = 0;
    while (fgets(line, sizeof line, f)) {
        int step, increment, attempt, count;
        if (sscanf(line, "%d %d %d %d", &step, &increment, &attempt, &count) == 4) *iterations += count;
    }
    fclose(f);
    return met == m->vertex_count ? worst : -1;
}

int main(int argc, char **argv)
{
    if (argc < 2) return 2;
    int cells = argc > 2 ? atoi(argv[2]) : 5, threads = argc > 3 ? atoi(argv[3]) : 1;
    if (cells < 1 || threads < 1) return 2;
    parallel_set_threads(threads);
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
        write_deck(argv[1], &m, &a, &table.material, move);
        bool ended = run_calculix(argv[1], threads, &theirs);
        int iterations = 0;
        double worst = ended ? compare(argv[1], &m, q.xyz, &iterations) : -1;
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
