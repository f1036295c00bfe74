/* live_pool: repeatable live predictions of one case for many threads. What a plan gives depends on it and its start
 * alone, not on which of them it gets, nor on the number of threads. */
#pragma once
#include "app/planner/predict/live.h"
#include <pthread.h>

typedef struct live_pool {
    const case_file *patient;
    const prepared *prepared;
    const bone_shapes *shapes;
    prediction_options options;
    pthread_mutex_t lock;
    int count;
    live **idle; /* [count] */
} live_pool;

/* Borrows c, p and shapes until live_pool_free. */
void live_pool_start(live_pool *l, const case_file *c, const prepared *p, const bone_shapes *shapes,
                     const prediction_options *options);
/* When none is in use. */
void live_pool_free(live_pool *l);
/* As live_predict; from many threads. */
bool live_pool_predict(live_pool *l, const plan_moves *moves, const double *start_xyz, const task *watch,
                       prediction *out, err *e) MUST_CHECK;
