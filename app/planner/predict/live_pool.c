#include "app/planner/predict/live_pool.h"
#include "geometry/mem.h"
#include <stdlib.h>

void live_pool_start(live_pool *l, const case_file *c, const prepared *p, const bone_shapes *shapes,
                     const prediction_options *options)
{
    *l = (live_pool){.patient = c, .prepared = p, .shapes = shapes, .options = *options};
    pthread_mutex_init(&l->lock, NULL);
}

void live_pool_free(live_pool *l)
{
    for (int i = 0; i < l->count; i++) live_free(&l->idle[i]);
    free(l->idle);
    pthread_mutex_destroy(&l->lock);
}

static live *take(live_pool *l)
{
    pthread_mutex_lock(&l->lock);
    live *one = l->count ? l->idle[--l->count] : NULL;
    pthread_mutex_unlock(&l->lock);
    return one;
}

static void give_back(live_pool *l, live *one)
{
    pthread_mutex_lock(&l->lock);
    l->idle = GROW_ARRAY(live *, l->idle, l->count + 1);
    l->idle[l->count++] = one;
    pthread_mutex_unlock(&l->lock);
}

bool live_pool_predict(live_pool *l, const plan_moves *moves, const double *start_xyz, const task *watch,
                       prediction *out, err *e)
{
    live *one = take(l);
    if (!one && !live_create(l->patient, l->prepared, l->shapes, &l->options, true, &one, e)) return false;
    bool ok = live_predict(one, moves, start_xyz, NULL, watch, out, e);
    give_back(l, one);
    return ok;
}
