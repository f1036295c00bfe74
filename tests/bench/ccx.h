/* ccx: the same problem for CalculiX (program ccx): its deck, one run of it and what it printed. Files of a job lie in
 * a folder under the job's name. What cannot be opened ends the program: these are measurements. */
#pragma once
#include "geometry/tetmesh.h"
#include "sim/material.h"
#include "tests/bench/yardstick.h"

typedef struct ccx_job {
    const char *folder, *name;
} ccx_job;

/* Mode "r" or "w"; ending: ".inp". The caller closes it. */
FILE *ccx_open(const ccx_job *job, const char *ending, const char *mode);
/* Begins a deck: nodes (set NALL, numbered from 1) and tets of one material (nhiso). The caller goes on. */
FILE *ccx_begin(const ccx_job *job, const tetmesh *m, const material *law);
/* One static step of large deformations to its end, with the tolerances of all benches; boundary conditions follow. */
void ccx_step(FILE *f);
/* What is printed (displacements of NALL; where held is not NULL, the sum of forces on that set too), and the end.
 * Closes f. */
void ccx_end(FILE *f, const char *held);

/* Wall and CPU seconds of ccx on so many threads; false: it did not end well. */
bool ccx_run(const ccx_job *job, int threads, spent *took);
/* Iterations of all increments, cut-back ones too. */
int ccx_iterations(const ccx_job *job);
/* Largest difference of a displacement component between xyz[3*nodes] and what was printed, mm; -1: some are missing.
 */
double ccx_difference(const ccx_job *job, const tetmesh *m, const double *xyz);
/* The sum of forces on the set of ccx_end, mN; false: it was not printed. */
bool ccx_total_force(const ccx_job *job, double force[3]);
