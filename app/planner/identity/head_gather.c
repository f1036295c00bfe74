#include "app/planner/identity/head_gather.h"
#include "app/planner/store/journal.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RECORD_HEAD = 1, RECORD_REFUSAL = 2 };

typedef struct gathering {
    const head_template *t;
    const head_source *from;
    const task *watch;
    size_t length;
    double **phi; /* [from->count] NULL: not there yet */
    err *refusal; /* [from->count] */
    journal keep;
    pthread_mutex_t lock;
    int32_t done, at_start;
    double begin_s;
    err *stop; /* the first that ends the work */
} gathering;

/* A record begins with the number of its head. */
static bool read_record(uint32_t kind, const void *bytes, size_t size, void *context, err *e)
{
    gathering *g = context;
    int64_t i = -1;
    if (size >= sizeof i) memcpy(&i, bytes, sizeof i);
    const char *rest = (const char *)bytes + sizeof i;
    bool known = i >= 0 && i < g->from->count && !g->phi[i] && !g->refusal[i].code;
    if (known && kind == RECORD_HEAD && size == sizeof i + g->length * sizeof(double))
        g->phi[i] = COPY_ARRAY(double, rest, g->length);
    else if (known && kind == RECORD_REFUSAL && size == sizeof i + sizeof(err))
        memcpy(&g->refusal[i], rest, sizeof(err));
    else
        return err_set(e, ERR_INPUT, "holds a record that is no head");
    g->done++;
    return true;
}

static bool keep(gathering *g, int64_t i, uint32_t kind, const void *what, size_t size, err *e)
{
    char *bytes = NEW_ARRAY(char, sizeof i + size);
    memcpy(bytes, &i, sizeof i);
    memcpy(bytes + sizeof i, what, size);
    bool ok = journal_add(&g->keep, kind, bytes, sizeof i + size, e);
    free(bytes);
    return ok;
}

static double *vector_of(gathering *g, int32_t i, err *e)
{
    head_shape s = {0};
    if (!g->from->shape(g->from->context, i, &s, e)) return NULL;
    double *phi = NULL;
    if (head_shape_to_frankfort(g->t, &s, NULL, e)) {
        phi = NEW_ARRAY(double, g->length);
        head_vector_of(g->t, &s, phi);
    }
    head_shape_free(&s);
    return phi;
}

static void tell(const gathering *g)
{
    int32_t all = g->from->count, fresh = g->done - g->at_start;
    char text[80];
    double left_s = fresh ? (clock_s() - g->begin_s) / fresh * (all - g->done) : 0;
    if (!fresh)
        snprintf(text, sizeof text, "heads, %d of %d", g->done, all);
    else if (left_s < 90)
        snprintf(text, sizeof text, "heads, %d of %d, %.0f s left", g->done, all, left_s);
    else
        snprintf(text, sizeof text, "heads, %d of %d, %.0f min left", g->done, all, left_s / 60);
    task_progress(g->watch, text, (double)g->done / all);
}

static bool is_own(err_code code) { return code == ERR_GEOMETRY || code == ERR_NOT_CONVERGED; }

static void one(gathering *g, int32_t i)
{
    err e = {0};
    pthread_mutex_lock(&g->lock);
    bool stopped = g->stop->code || (task_interrupted(g->watch) && !err_set(g->stop, ERR_INTERRUPTED, "interrupted"));
    pthread_mutex_unlock(&g->lock);
    if (stopped) return;
    double *phi = vector_of(g, i, &e);
    pthread_mutex_lock(&g->lock);
    if (phi || is_own(e.code)) {
        bool kept = phi ? keep(g, i, RECORD_HEAD, phi, g->length * sizeof *phi, g->stop)
                        : keep(g, i, RECORD_REFUSAL, &e, sizeof e, g->stop);
        g->phi[i] = phi;
        if (!phi) g->refusal[i] = e;
        g->done += kept;
        tell(g);
    } else if (!g->stop->code) {
        *g->stop = e;
        err_prefix(g->stop, "%s", g->from->name[i]);
    }
    pthread_mutex_unlock(&g->lock);
}

static void some(int64_t begin, int64_t end, void *context)
{
    gathering *g = context;
    for (int64_t i = begin; i < end; i++)
        if (!g->phi[i] && !g->refusal[i].code) one(g, (int32_t)i);
}

static bool sort_out(gathering *g, head_set *out, err *e)
{
    int32_t all = g->from->count, first = -1;
    for (int32_t i = 0; i < all; i++) {
        if (g->phi[i]) continue;
        if (!out->refused++) first = i;
        task_note(g->watch, "%s is left out: %s", g->from->name[i], g->refusal[i].text);
    }
    if (10 * out->refused > all)
        return err_set(e, g->refusal[first].code, "%d of %d heads are left out, more than one in ten; %s: %s",
                       out->refused, all, g->from->name[first], g->refusal[first].text);
    out->phi = NEW_ARRAY(double *, all);
    out->name = NEW_ARRAY(const char *, all);
    for (int32_t i = 0; i < all; i++) {
        if (!g->phi[i]) continue;
        out->phi[out->count] = g->phi[i];
        out->name[out->count++] = g->from->name[i];
        g->phi[i] = NULL;
    }
    return true;
}

bool head_gather(const head_template *t, const head_source *from, const char *key, const char *journal_path, bool anew,
                 const task *watch, head_set *out, err *e)
{
    head_layout l = head_layout_of(t);
    gathering g = {.t = t,
                   .from = from,
                   .watch = watch,
                   .length = (size_t)l.start[HEAD_BLOCK_COUNT],
                   .phi = NEW_ARRAY(double *, from->count),
                   .refusal = NEW_ARRAY(err, from->count),
                   .stop = e};
    char whole_key[HASH_TEXT_SIZE];
    content_hash *h = content_hash_start();
    content_hash_text(h, "template", t->hash); /* a fit depends on every place of it */
    content_hash_text(h, "source", key);
    for (int32_t i = 0; i < from->count; i++) content_hash_text(h, "head", from->name[i]);
    content_hash_end(h, whole_key);
    head_set made = {0};
    bool ok = journal_open(journal_path, whole_key, anew, read_record, &g, &g.keep, e);
    if (ok) {
        pthread_mutex_init(&g.lock, NULL);
        g.at_start = g.done;
        g.begin_s = clock_s();
        tell(&g);
        parallel_for(from->count, 1, some, &g);
        made.seconds = clock_s() - g.begin_s;
        made.fresh = g.done - g.at_start;
        pthread_mutex_destroy(&g.lock);
        journal_close(&g.keep);
        ok = !e->code && sort_out(&g, &made, e);
    }
    for (int32_t i = 0; i < from->count; i++) free(g.phi[i]);
    free(g.phi);
    free(g.refusal);
    if (ok) *out = made;
    return ok;
}

void head_set_free(head_set *s)
{
    for (int32_t i = 0; i < s->count; i++) free(s->phi[i]);
    free(s->phi);
    free(s->name);
    *s = (head_set){0};
}
