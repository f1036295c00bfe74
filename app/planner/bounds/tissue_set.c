#include "app/planner/bounds/tissue_set.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t place_size = SAMPLE_AXES_MAX * sizeof(int32_t);

void tissue_set_start(tissue_set *t)
{
    t->count = t->rounds = 0;
    t->point = NULL;
    pthread_mutex_init(&t->lock, NULL);
}

void tissue_set_free(tissue_set *t)
{
    for (int i = 0; i < t->count; i++) free(t->point[i].shift);
    free(t->point);
    pthread_mutex_destroy(&t->lock);
    *t = (tissue_set){0};
}

const tissue_point *tissue_set_find(const tissue_set *t, const int32_t at[SAMPLE_AXES_MAX])
{
    for (int i = 0; i < t->count; i++)
        if (!memcmp(t->point[i].at, at, place_size)) return &t->point[i];
    return NULL;
}

static void add(tissue_set *t, const tissue_point *p)
{
    t->point = GROW_ARRAY(tissue_point, t->point, t->count + 1);
    t->point[t->count++] = *p;
}

void tissue_set_put(tissue_set *t, const tissue_point *p)
{
    tissue_point own = *p;
    own.shift = COPY_ARRAY(float, p->shift, 3 * (size_t)t->mesh->vertex_count);
    add(t, &own);
}

static double distance(const int32_t *a, const int32_t *b)
{
    double sum = 0;
    for (int k = 0; k < SAMPLE_AXES_MAX; k++) sum += (double)(a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/* The nearest point of an earlier round with a solution; of equals the first by place. NULL: from rest. */
static const tissue_point *neighbour(const tissue_set *t, const int32_t *at, int round)
{
    static const int32_t rest[SAMPLE_AXES_MAX] = {0};
    const tissue_point *best = NULL;
    double least = t->starts_at_rest ? distance(at, rest) : HUGE_VAL;
    for (int i = 0; i < t->count; i++) {
        const tissue_point *p = &t->point[i];
        double d = distance(at, p->at);
        if (p->round >= round || p->v.level == VERDICT_STOP) continue;
        if (d > least || (d == least && !(best && memcmp(p->at, best->at, place_size) < 0))) continue;
        least = d;
        best = p;
    }
    return best;
}

struct round {
    tissue_set *set;
    tissue_point *point;
    bool *done;
    err *e;
    int number, count, finished;
};

static bool solve(const struct round *r, tissue_point *p, err *e)
{
    tissue_set *t = r->set;
    size_t n = 3 * (size_t)t->mesh->vertex_count;
    const tissue_point *from = neighbour(t, p->at, r->number);
    double *start = from ? NEW_ARRAY(double, n) : NULL;
    for (size_t i = 0; from && i < n; i++) start[i] = t->mesh->xyz[i] + (double)from->shift[i];
    equilibrium q = {0};
    bool ok = t->solve(p->at, start, t->context, &q, &p->v, e);
    if (ok && q.outcome == STOPPED_INTERRUPTED) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    if (ok) {
        p->round = r->number;
        p->iterations = q.iterations;
        p->min_j = q.extremes.min_j;
        p->warm = from != NULL;
        p->shift = NEW_ARRAY(float, n);
        for (size_t i = 0; i < n; i++) p->shift[i] = (float)(q.xyz[i] - t->mesh->xyz[i]);
    }
    equilibrium_free(&q);
    free(start);
    return ok;
}

static void solve_some(int64_t begin, int64_t end, void *context)
{
    struct round *r = context;
    tissue_set *t = r->set;
    for (int64_t i = begin; i < end && i < r->count; i++) {
        bool ok = solve(r, &r->point[i], &r->e[i]);
        pthread_mutex_lock(&t->lock);
        if (ok && t->keep) ok = t->keep(&r->point[i], t->context, &r->e[i]);
        r->finished++;
        if (ok && t->progress) t->progress(r->finished, r->count, t->context);
        pthread_mutex_unlock(&t->lock);
        r->done[i] = ok;
    }
}

bool tissue_set_ask(tissue_set *t, const int32_t *at, int count, err *e)
{
    struct round r = {.set = t,
                      .point = NEW_ARRAY(tissue_point, count),
                      .done = NEW_ARRAY(bool, count),
                      .e = NEW_ARRAY(err, count),
                      .number = t->rounds++};
    for (int i = 0; i < count; i++) {
        const int32_t *p = at + SAMPLE_AXES_MAX * (int64_t)i;
        bool known = tissue_set_find(t, p) != NULL;
        for (int k = 0; k < r.count && !known; k++) known = !memcmp(r.point[k].at, p, place_size);
        if (!known) memcpy(r.point[r.count++].at, p, place_size);
    }
    parallel_for(r.count + 1, 1, solve_some, &r); /* one more than there are: a last one alone has one core too */
    bool ok = true;
    for (int i = 0; i < r.count; i++) {
        if (r.done[i])
            add(t, &r.point[i]);
        else {
            free(r.point[i].shift);
            if (ok) ok = err_set(e, r.e[i].code, "%s", r.e[i].text);
        }
    }
    free(r.point);
    free(r.done);
    free(r.e);
    return ok;
}

static int by_place(const void *a, const void *b)
{
    const tissue_point *p = a, *q = b;
    for (int k = 0; k < SAMPLE_AXES_MAX; k++)
        if (p->at[k] != q->at[k]) return p->at[k] < q->at[k] ? -1 : 1;
    return 0;
}

void tissue_set_sort(tissue_set *t) { qsort(t->point, (size_t)t->count, sizeof *t->point, by_place); }
