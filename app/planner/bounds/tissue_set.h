/* tissue_set: points of a plan's controls at which the soft tissue is solved, each once, from the nearest one solved
 * before.
 *
 * Points are asked for in rounds. Those of one round are solved side by side, one core each, and start from points of
 * earlier rounds only, so that what comes out depends neither on the number of threads nor on the order in which they
 * end, nor on an interruption. */
#pragma once
#include "app/planner/bounds/sample_set.h"
#include "sim/equilibrium.h"
#include <pthread.h>

typedef struct tissue_point {
    int32_t at[SAMPLE_AXES_MAX];
    verdict v;
    double min_j;                    /* smallest volume ratio of a tetrahedron */
    int32_t round, iterations, warm; /* warm: 1 it started from another point */
    float *shift;                    /* [3*nodes] from rest, mm: as far as a start needs it */
} tissue_point;

typedef struct tissue_set {
    /* What the caller sets. */
    const tetmesh *mesh; /* at rest */
    bool starts_at_rest; /* the point 0 is the tissue at rest: points nearest to it start there */
    /* Solves a point from start_xyz[3*nodes], from rest where that is NULL, and judges the tissue. From many threads.
     */
    bool (*solve)(const int32_t *at, const double *start_xyz, void *context, equilibrium *out, verdict *v, err *e);
    bool (*keep)(const tissue_point *p, void *context, err *e); /* NULL, or told each new point, one at a time */
    void (*progress)(int done, int count, void *context);       /* of a round; NULL or told */
    void *context;
    /* What is found. */
    int count, rounds;
    tissue_point *point; /* [count] */
    /* private */
    pthread_mutex_t lock;
} tissue_set;

void tissue_set_start(tissue_set *t); /* after the caller has filled its part */
void tissue_set_free(tissue_set *t);
/* Takes over a point solved earlier, shift included. */
void tissue_set_put(tissue_set *t, const tissue_point *p);
/* One round. Refuses what the callbacks and the solver refuse, and an interruption. */
bool tissue_set_ask(tissue_set *t, const int32_t *at, int count, err *e) MUST_CHECK;
const tissue_point *tissue_set_find(const tissue_set *t, const int32_t at[SAMPLE_AXES_MAX]); /* NULL: not solved */
/* Orders the points as sample_set_sort does. */
void tissue_set_sort(tissue_set *t);
