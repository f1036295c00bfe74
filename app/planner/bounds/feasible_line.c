#include "app/planner/bounds/feasible_line.h"
#include "geometry/mem.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static void place(const int32_t *direction, int32_t t, int32_t *at)
{
    for (int k = 0; k < SAMPLE_AXES_MAX; k++) at[k] = t * direction[k];
}

static const verdict *known(const sample_set *s, const int32_t *direction, int32_t t)
{
    int32_t at[SAMPLE_AXES_MAX];
    place(direction, t, at);
    const verdict *v = sample_set_find(s, at);
    assert(v);
    return v;
}

static bool ask(sample_set *s, const int32_t *direction, const int32_t *t, int64_t count, err *e)
{
    int32_t *at = NEW_ARRAY(int32_t, SAMPLE_AXES_MAX * count);
    for (int64_t i = 0; i < count; i++) place(direction, t[i], at + SAMPLE_AXES_MAX * i);
    bool ok = sample_set_ask(s, at, count, e);
    free(at);
    return ok;
}

/* Multiples of the stride and both ends, in order. */
static int64_t make_ticks(int32_t low, int32_t high, int32_t stride, int32_t **out)
{
    int32_t *t = NEW_ARRAY(int32_t, (int64_t)(high - low) / stride + 3);
    int64_t n = 0;
    t[n++] = low;
    for (int32_t k = low / stride * stride; k < high; k += stride)
        if (k > low) t[n++] = k;
    if (high > low) t[n++] = high;
    *out = t;
    return n;
}

static void make_pieces(const sample_set *s, const int32_t *t, int64_t count, feasible_line *out)
{
    out->piece = NEW_ARRAY(line_piece, count);
    for (int64_t i = 0; i < count; i++) {
        const verdict *v = known(s, out->direction, t[i]);
        line_piece *p = out->piece_count ? &out->piece[out->piece_count - 1] : NULL;
        if (p && p->level == v->level) {
            p->to = t[i];
            if (t[i] <= 0) { /* the end towards the base */
                p->reason = v->reason;
                p->value = v->value;
            }
        } else {
            out->piece[out->piece_count++] =
                (line_piece){.from = t[i], .to = t[i], .level = v->level, .reason = v->reason, .value = v->value};
        }
        if (t[i] == 0) out->base = out->piece_count - 1;
    }
}

bool feasible_line_find(sample_set *s, const int32_t direction[SAMPLE_AXES_MAX], int32_t low, int32_t high,
                        int32_t stride, feasible_line *out, err *e)
{
    assert(low <= 0 && high >= 0 && stride > 0);
    feasible_line l = {0};
    memcpy(l.direction, direction, sizeof l.direction);
    int32_t *t, *middle = NULL;
    int64_t count = make_ticks(low, high, stride, &t), added = 1;
    bool ok = ask(s, l.direction, t, count, e);
    while (ok && added) {
        int32_t *more = NEW_ARRAY(int32_t, 2 * count);
        int64_t n = 0;
        middle = GROW_ARRAY(int32_t, middle, count);
        added = 0;
        for (int64_t i = 0; i < count; i++) {
            more[n++] = t[i];
            if (i + 1 == count || t[i + 1] - t[i] < 2) continue;
            if (known(s, l.direction, t[i])->level == known(s, l.direction, t[i + 1])->level) continue;
            more[n++] = middle[added++] = t[i] + (t[i + 1] - t[i]) / 2;
        }
        free(t);
        t = more;
        count = n;
        ok = ask(s, l.direction, middle, added, e);
    }
    if (ok) {
        make_pieces(s, t, count, &l);
        *out = l;
    }
    free(t);
    free(middle);
    return ok;
}

void feasible_line_free(feasible_line *l)
{
    free(l->piece);
    *l = (feasible_line){0};
}

int feasible_line_reach(const feasible_line *l, int end, verdict_level level)
{
    int i = l->base;
    if (l->piece[i].level >= (int)level) return -1;
    while (i + end >= 0 && i + end < l->piece_count && l->piece[i + end].level < (int)level) i += end;
    return i;
}
