/* study: error against run time of one case. A rung is one way to compute the same prediction: a mesh, an
 * element, a tolerance, a model, a number of threads, a scene. Each is solved in a child process (its peak of
 * memory is its own) and kept in a journal, DIR/runs: a study that was stopped goes on where it was. */
#pragma once
#include "app/planner/predict/carried.h"
#include "app/planner/store/task.h"
#include "app/planner/predict/plan_contact.h"
#include "sim/equilibrium.h"

typedef enum study_group {
    GROUP_MESH,
    GROUP_ELEMENT,
    GROUP_TOLERANCE,
    GROUP_MATERIAL,
    GROUP_THREADS,
    GROUP_SCENE,
    GROUP_COUNT
} study_group;

typedef struct study_rung {
    const char *name;
    int group;
    double coarsening; /* edge lengths over those of the case */
    int refined;       /* times that every tet became eight */
    int element;       /* element_kind; auto: the case's */
    double rel_tol;    /* 0: the solver's default */
    int model;         /* material_model */
    double poisson;    /* 0: the case's */
    int threads;       /* 0: all cores, or -j */
    contact_kind contact;
    int load_steps;  /* 0: the plan's */
    double scene_mm; /* tissue expected to move less is left out, as gnathos predict does; 0: none is */
} study_rung;

extern const study_rung study_rungs[];
extern const int study_rung_count;
/* The rung whose settings are the case's own; its halved mesh, with which all are compared; one mesh, halved,
 * and halved twice, for the order. */
extern const int study_default, study_reference, study_family[3];

/* Plain data. */
typedef struct study_result {
    bool solved;
    char text[200]; /* the solver's outcome, or why there is none */
    int32_t nodes, tets;
    int64_t unknowns;
    double size_mm; /* cube root of the mean volume of a tet */
    int iterations, free_iterations, contact_iterations, factorisations, loads;
    double wall_s, cpu_s, peak_mb; /* of the solve; of the process */
    double prepare_s, assemble_s, factor_s,
        solve_s;      /* wall: ordering; forces and matrices; factors; back substitution */
    double meshing_s; /* wall: bones and tissue, once per mesh; 0: not known */
    double residual_mn, initial_mn, min_j;
    int32_t inverted;
} study_result;

/* One rung as the journal has it. */
typedef struct study_run {
    const study_rung *rung;
    study_result result;
    int32_t skin_count;
    double *skin_mm; /* [3*skin_count] displacement; NULL where not solved */
    int32_t point_count;
    double *point_mm; /* [3*point_count] displacement of the case's landmarks */
} study_run;
void study_run_free(study_run *r);

/* What is solved: a case, bones that move, and where things are kept. */
typedef struct study_task {
    const case_file *patient;
    rigid motion[SEGMENT_COUNT];
    int load_steps;
    const task *watch;        /* may be NULL */
    char key[HASH_TEXT_SIZE]; /* of program, case and motion */
    const char *folder;       /* holds runs/ and prepared/ */
    const char *cache;        /* of the case's own mesh; NULL: CASE/prepared */
    const char *name;         /* of the motion, in file names */
} study_task;

/* Fills key. */
bool study_task_key(study_task *t, err *e) MUST_CHECK;
/* From the journal, else solved now. A solve that fails is a result. Refuses what prepared_get refuses, and
 * ERR_INTERRUPTED. *fresh: it was solved now. */
bool study_get(const study_task *t, const study_rung *rung, study_run *out, bool *fresh, err *e) MUST_CHECK;

/* Distances between the skins of two runs, over the vertices that move by more than 0.1 mm in b. */
typedef struct study_error {
    double mean_mm, p95_mm, max_mm;
    int32_t vertices;
} study_error;
study_error study_compare(const study_run *a, const study_run *b);

/* The order p of errors C h^p from a mesh, its half and its quarter, where the first two are d[0] and d[1]
 * from the last: d[0] / d[1] = (4^p - 1) / (2^p - 1) = 2^p + 1. NaN: that gives no p above 0.2. */
double study_order(const double d[2]);
/* Least squares slope of log error over log size; NaN for fewer than two. */
double study_slope(const double *h, const double *error, int count);

/* The same solver on a question with an exact answer: a turned tube, 4 to 16 cells through its wall. Plain
 * data. */
enum { STUDY_TUBES = 12 };
typedef struct study_tube {
    int cells;
    bool average, solved;
    double poisson;
    int64_t unknowns;
    int iterations;
    double wall_s, error_mm; /* root mean square over the nodes; their largest displacement is 4.5 mm */
} study_tube;
bool study_tubes(const study_task *task, study_tube out[STUDY_TUBES], err *e) MUST_CHECK;

typedef struct study_table {
    const study_task *task;
    const char *plan_name;
    int count;
    study_run *run;                   /* [count] as study_rungs */
    study_error *error;               /* [count] to the reference */
    study_error *change;              /* [count] to the case's own settings, of runs on its own mesh; else NaN */
    bool *best;                       /* [count] on the Pareto front of the mean error over wall time */
    double order, reference_error_mm; /* Richardson: of the family; of the reference, in the mean */
    double plain_slope, average_slope;
    int32_t cores;
    study_tube tube[STUDY_TUBES];
} study_table;
void study_table_make(study_table *t); /* from task, run */
void study_table_free(study_table *t);
/* The fastest run whose error and own_mm, of the reference, are at most so large; -1: none. p95: by the 95th
 * percentile, else by the mean. */
int study_soonest(const study_table *t, double limit_mm, bool p95, double own_mm);

const char *study_group_name(int group);
/* study.json (the record), study.md, study.csv, error_time.png/.svg, error_size.png/.svg in the folder. */
bool study_write(const study_table *t, const json_t *record, const char *folder, err *e) MUST_CHECK;
void study_print(const study_table *t, FILE *out);
bool study_plot(const study_table *t, const char *folder, err *e) MUST_CHECK;

/* gnathos study --ratios: the standard moves. Prints the table or, if record is not NULL, sets it to a new object, and
 * writes ratios.json (the same), ratios.md and ratios.csv. p: of the case's own mesh; the lips' edges are added to its
 * landmarks. */
bool study_ratios(study_task *t, prepared *p, FILE *out, json_t **record, err *e) MUST_CHECK;
