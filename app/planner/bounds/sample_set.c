#include "app/planner/bounds/sample_set.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 256 }; /* points between two looks at what went wrong */

static const size_t point_size = SAMPLE_AXES_MAX * sizeof(int32_t);

sample_set sample_set_new(const sample_params *p) { return (sample_set){.params = *p}; }

void sample_set_free(sample_set *s)
{
    free(s->item);
    free(s->slot);
    *s = (sample_set){0};
}

/* FNV-1a over the numbers. */
static uint64_t hash_of(const int32_t *at)
{
    uint64_t h = 14695981039346656037u;
    for (int k = 0; k < SAMPLE_AXES_MAX; k++) h = (h ^ (uint32_t)at[k]) * 1099511628211u;
    return h ^ h >> 29;
}

/* The slot that holds the point, or the empty one where it would go. */
static int64_t slot_of(const sample_set *s, const int32_t *at)
{
    int64_t i = (int64_t)(hash_of(at) % (uint64_t)s->slot_count);
    while (s->slot[i] && memcmp(s->item[s->slot[i] - 1].at, at, point_size)) i = (i + 1) % s->slot_count;
    return i;
}

static void index_all(sample_set *s)
{
    free(s->slot);
    s->slot = NEW_ARRAY(int64_t, s->slot_count);
    for (int64_t i = 0; i < s->count; i++) s->slot[slot_of(s, s->item[i].at)] = i + 1;
}

static void add(sample_set *s, const sample *one)
{
    if (2 * (s->count + 1) > s->slot_count) {
        s->slot_count = s->slot_count ? 2 * s->slot_count : 1024;
        s->item = GROW_ARRAY(sample, s->item, s->slot_count / 2);
        index_all(s);
    }
    s->item[s->count] = *one;
    s->slot[slot_of(s, one->at)] = ++s->count;
}

bool sample_set_put(sample_set *s, const sample *one)
{
    if (sample_set_find(s, one->at)) return false;
    add(s, one);
    return true;
}

const verdict *sample_set_find(const sample_set *s, const int32_t at[SAMPLE_AXES_MAX])
{
    int64_t i = s->count ? s->slot[slot_of(s, at)] : 0;
    return i ? &s->item[i - 1].v : NULL;
}

struct batch {
    sample_set *set;
    sample one[CHUNK];
    bool done[CHUNK];
    err e[CHUNK];
    pthread_mutex_t lock;
};

static void judge_some(int64_t begin, int64_t end, void *context)
{
    struct batch *b = context;
    const sample_params *p = &b->set->params;
    for (int64_t i = begin; i < end; i++) {
        if (p->interrupted && p->interrupted(p->context)) {
            err_set(&b->e[i], ERR_INTERRUPTED, "interrupted");
            return;
        }
        bool ok = p->judge(b->one[i].at, p->context, &b->one[i].v, &b->e[i]);
        pthread_mutex_lock(&b->lock);
        if (ok && p->keep) ok = p->keep(&b->one[i], p->context, &b->e[i]);
        if (ok) {
            b->set->judged++;
            if (p->progress) p->progress(b->set->judged, p->context);
        }
        pthread_mutex_unlock(&b->lock);
        b->done[i] = ok;
    }
}

bool sample_set_ask(sample_set *s, const int32_t *at, int64_t count, err *e)
{
    struct batch *b = NEW_ARRAY(struct batch, 1);
    pthread_mutex_init(&b->lock, NULL);
    b->set = s;
    bool ok = true;
    for (int64_t next = 0; ok && next < count;) {
        int n = 0;
        for (; next < count && n < CHUNK; next++) {
            const int32_t *p = at + SAMPLE_AXES_MAX * next;
            bool known = sample_set_find(s, p) != NULL;
            for (int i = 0; i < n && !known; i++) known = !memcmp(b->one[i].at, p, point_size);
            if (known) continue;
            b->one[n] = (sample){0};
            memcpy(b->one[n].at, p, point_size);
            b->done[n] = false;
            b->e[n++] = (err){0};
        }
        parallel_for(n, 1, judge_some, b);
        for (int i = 0; i < n; i++) {
            if (b->done[i])
                add(s, &b->one[i]);
            else if (ok)
                ok = err_set(e, b->e[i].code, "%s", b->e[i].text);
        }
    }
    pthread_mutex_destroy(&b->lock);
    free(b);
    return ok;
}

static int by_place(const void *a, const void *b)
{
    const sample *p = a, *q = b;
    for (int k = 0; k < SAMPLE_AXES_MAX; k++)
        if (p->at[k] != q->at[k]) return p->at[k] < q->at[k] ? -1 : 1;
    return 0;
}

void sample_set_sort(sample_set *s)
{
    qsort(s->item, (size_t)s->count, sizeof *s->item, by_place);
    if (s->slot_count) index_all(s);
}
