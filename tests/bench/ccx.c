#include "tests/bench/ccx.h"
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

FILE *ccx_open(const ccx_job *job, const char *ending, const char *mode)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s%s", job->folder, job->name, ending);
    FILE *f = fopen(path, mode);
    if (!f) {
        fprintf(stderr, "%s: cannot be opened\n", path);
        exit(1);
    }
    return f;
}

FILE *ccx_begin(const ccx_job *job, const tetmesh *m, const material *law)
{
    FILE *f = ccx_open(job, ".inp", "w");
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
            "*SOLID SECTION,ELSET=EALL,MATERIAL=TISSUE\n",
            law->mu_kpa / 2, 2 / law->lambda_kpa);
    return f;
}

void ccx_step(FILE *f)
{
    fprintf(f, "*STEP,NLGEOM,INC=2000\n*STATIC\n1,1.\n*CONTROLS,PARAMETERS=FIELD\n1.e-8,1.e-6\n");
}

void ccx_end(FILE *f, const char *held)
{
    fprintf(f, "*NODE PRINT,NSET=NALL\nU\n");
    if (held) fprintf(f, "*NODE PRINT,NSET=%s,TOTALS=ONLY\nRF\n", held);
    fprintf(f, "*END STEP\n");
    fclose(f);
}

bool ccx_run(const ccx_job *job, int threads, spent *took)
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
        if (chdir(job->folder) == 0 && freopen("ccx.log", "w", stdout)) execlp("ccx", "ccx", job->name, (char *)NULL);
        _exit(127);
    }
    if (wait4(child, &status, 0, &used) != child) return false;
    *took = (spent){clock_s() - begin, (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                                           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec)};
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int ccx_iterations(const ccx_job *job)
{
    FILE *f = ccx_open(job, ".sta", "r");
    char line[256];
    int sum = 0;
    while (fgets(line, sizeof line, f)) {
        int step, increment, attempt, count;
        if (sscanf(line, "%d %d %d %d", &step, &increment, &attempt, &count) == 4) sum += count;
    }
    fclose(f);
    return sum;
}

double ccx_difference(const ccx_job *job, const tetmesh *m, const double *xyz)
{
    FILE *f = ccx_open(job, ".dat", "r");
    char line[256];
    double worst = 0;
    int32_t met = 0, node;
    while (fgets(line, sizeof line, f)) {
        double u[3];
        char after; /* a total has no node before it */
        if (sscanf(line, "%d%c %lf %lf %lf", &node, &after, u, u + 1, u + 2) != 5 || after != ' ') continue;
        if (node < 1 || node > m->vertex_count) continue;
        met++;
        for (int c = 0; c < 3; c++) {
            size_t i = 3 * (size_t)(node - 1) + (size_t)c;
            worst = fmax(worst, fabs(xyz[i] - m->xyz[i] - u[c]));
        }
    }
    fclose(f);
    return met == m->vertex_count ? worst : -1;
}

bool ccx_total_force(const ccx_job *job, double force[3])
{
    FILE *f = ccx_open(job, ".dat", "r");
    char line[256];
    bool met = false;
    while (fgets(line, sizeof line, f))
        if (strstr(line, "total force"))
            while (fgets(line, sizeof line, f) && !met)
                met = sscanf(line, "%lf %lf %lf", force, force + 1, force + 2) == 3;
    fclose(f);
    return met;
}
