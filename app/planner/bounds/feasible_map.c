#include "app/planner/bounds/feasible_parts.h"
#include "geometry/mem.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

typedef struct cell { /* closed box of nodes */
    int32_t low[3], high[3];
} cell;

struct cells {
    int64_t count, room;
    cell *item;
};

static void push(struct cells *l, const cell *c)
{
    if (l->count == l->room) l->item = GROW_ARRAY(cell, l->item, l->room = 2 * l->room + 64);
    l->item[l->count++] = *c;
}

void feasible_map_place(const feasible_map *m, int64_t node, int32_t at[SAMPLE_AXES_MAX])
{
    int32_t i[3];
    node_index(m, node, i);
    memset(at, 0, SAMPLE_AXES_MAX * sizeof *at);
    for (int k = 0; k < m->params.axis_count; k++) at[m->params.axis[k]] = m->params.low[k] + i[k] * m->params.spacing;
}

/* Node numbers of the coarse planes of one axis: multiples of `coarse` from the base, and both ends. */
static int32_t make_ticks(const feasible_map *m, int k, int32_t *tick)
{
    const feasible_map_params *p = &m->params;
    if (k >= p->axis_count) return 0;
    int32_t n = 0, last = m->count[k] - 1;
    tick[n++] = 0;
    for (int32_t i = 1; i < last; i++)
        if ((p->low[k] + i * p->spacing) % p->coarse == 0) tick[n++] = i;
    if (last > 0) tick[n++] = last;
    return n;
}

static void make_cells(const feasible_map *m, struct cells *out)
{
    int32_t *tick[3], n[3];
    for (int k = 0; k < 3; k++) {
        tick[k] = NEW_ARRAY(int32_t, m->count[k] + 1);
        n[k] = make_ticks(m, k, tick[k]);
    }
    for (int32_t c = 0; c < (n[2] > 1 ? n[2] - 1 : 1); c++)
        for (int32_t b = 0; b + 1 < n[1]; b++)
            for (int32_t a = 0; a + 1 < n[0]; a++) {
                cell one = {{tick[0][a], tick[1][b], 0}, {tick[0][a + 1], tick[1][b + 1], 0}};
                if (n[2] > 1) {
                    one.low[2] = tick[2][c];
                    one.high[2] = tick[2][c + 1];
                }
                push(out, &one);
            }
    for (int k = 0; k < 3; k++) free(tick[k]);
}

/* Judges these nodes and writes their verdicts down. */
static bool judge_nodes(sample_set *s, feasible_map *m, const int64_t *node, int64_t count, err *e)
{
    int32_t *at = NEW_ARRAY(int32_t, SAMPLE_AXES_MAX * count);
    for (int64_t i = 0; i < count; i++) feasible_map_place(m, node[i], at + SAMPLE_AXES_MAX * i);
    bool ok = sample_set_ask(s, at, count, e);
    for (int64_t i = 0; ok && i < count; i++) {
        m->node[node[i]] = *sample_set_find(s, at + SAMPLE_AXES_MAX * i);
        m->judged[node[i]] = 1;
    }
    free(at);
    return ok;
}

static bool judge_corners(sample_set *s, feasible_map *m, const struct cells *l, err *e)
{
    int64_t *node = NEW_ARRAY(int64_t, 8 * l->count), n = 0;
    uint8_t *asked = NEW_ARRAY(uint8_t, m->node_count);
    for (int64_t c = 0; c < l->count; c++)
        for (int corner = 0; corner < 1 << m->params.axis_count; corner++) {
            int32_t i[3];
            for (int k = 0; k < 3; k++) i[k] = corner >> k & 1 ? l->item[c].high[k] : l->item[c].low[k];
            int64_t at = node_at(m, i);
            if (m->judged[at] || asked[at]) continue;
            asked[at] = 1;
            node[n++] = at;
        }
    bool ok = judge_nodes(s, m, node, n, e);
    free(node);
    free(asked);
    return ok;
}

static bool same_kind(const feasible_map_params *p, const verdict *a, const verdict *b)
{
    return a->level == b->level && (!p->reasons || a->level == VERDICT_FINE || a->reason == b->reason);
}

/* Judged nodes of different kinds in the closed cell, which is wider than one node. */
static bool mixed(const feasible_map *m, const cell *c)
{
    const verdict *first = NULL;
    int32_t i[3];
    for (i[2] = c->low[2]; i[2] <= c->high[2]; i[2]++)
        for (i[1] = c->low[1]; i[1] <= c->high[1]; i[1]++)
            for (i[0] = c->low[0]; i[0] <= c->high[0]; i[0]++) {
                int64_t at = node_at(m, i);
                if (!m->judged[at]) continue;
                if (!first) first = &m->node[at];
                if (!same_kind(&m->params, first, &m->node[at])) return true;
            }
    return false;
}

static bool is_small(const cell *c)
{
    return c->high[0] - c->low[0] < 2 && c->high[1] - c->low[1] < 2 && c->high[2] - c->low[2] < 2;
}

static void split(const cell *c, struct cells *to)
{
    for (int part = 0; part < 8; part++) {
        cell one = *c;
        bool there = true;
        for (int k = 0; k < 3; k++) {
            int32_t wide = c->high[k] - c->low[k], middle = c->low[k] + wide / 2;
            if (wide < 2)
                there = there && !(part >> k & 1);
            else if (part >> k & 1)
                one.low[k] = middle;
            else
                one.high[k] = middle;
        }
        if (there) push(to, &one);
    }
}

/* Nodes that were not judged take the verdict of the nearest corner of the cell around them. */
static void fill(feasible_map *m, const struct cells *l, uint8_t *filled)
{
    for (int64_t n = 0; n < l->count; n++) {
        const cell *c = &l->item[n];
        int32_t i[3], corner[3];
        for (i[2] = c->low[2]; i[2] <= c->high[2]; i[2]++)
            for (i[1] = c->low[1]; i[1] <= c->high[1]; i[1]++)
                for (i[0] = c->low[0]; i[0] <= c->high[0]; i[0]++) {
                    int64_t at = node_at(m, i);
                    if (m->judged[at] || filled[at]) continue;
                    filled[at] = 1;
                    for (int k = 0; k < 3; k++) corner[k] = 2 * i[k] <= c->low[k] + c->high[k] ? c->low[k] : c->high[k];
                    m->node[at] = m->node[node_at(m, corner)];
                }
    }
}

static bool refine(sample_set *s, feasible_map *m, err *e)
{
    struct cells now = {0};
    make_cells(m, &now);
    bool ok = judge_corners(s, m, &now, e);
    for (bool changed = true; ok && changed;) {
        struct cells next = {0};
        changed = false;
        for (int64_t c = 0; c < now.count; c++) {
            if (is_small(&now.item[c]) || !mixed(m, &now.item[c])) {
                push(&next, &now.item[c]);
            } else {
                split(&now.item[c], &next);
                changed = true;
            }
        }
        free(now.item);
        now = next;
        ok = judge_corners(s, m, &now, e);
    }
    uint8_t *filled = NEW_ARRAY(uint8_t, m->node_count);
    if (ok) fill(m, &now, filled);
    free(filled);
    free(now.item);
    return ok;
}

struct crossing {
    int64_t node;
    int axis;
    int32_t near, far; /* steps from the node: one side of the change, the other */
    bool rising;       /* far has the worse level */
    int32_t worse;
};

/* Halves every edge between nodes of different levels to one step. */
static bool find_edges(sample_set *s, feasible_map *m, err *e)
{
    struct crossing *x = NEW_ARRAY(struct crossing, 2 * m->node_count);
    int64_t n = 0;
    for (int k = 0; k < 2; k++) {
        m->edge[k] = NEW_ARRAY(double, m->node_count);
        for (int64_t a = 0; a < m->node_count; a++) {
            int32_t i[3];
            m->edge[k][a] = -1;
            node_index(m, a, i);
            if (++i[k] >= m->count[k]) continue;
            int32_t here = m->node[a].level, there = m->node[node_at(m, i)].level;
            if (here == there) continue;
            x[n++] = (struct crossing){a, k, 0, m->params.spacing, there > here, there > here ? there : here};
        }
    }
    bool ok = true;
    int32_t *at = NEW_ARRAY(int32_t, SAMPLE_AXES_MAX * n);
    for (int32_t wide = m->params.spacing; ok && wide > 1; wide = (wide + 1) / 2) {
        for (int64_t i = 0; i < n; i++) {
            feasible_map_place(m, x[i].node, at + SAMPLE_AXES_MAX * i);
            at[SAMPLE_AXES_MAX * i + m->params.axis[x[i].axis]] += (x[i].near + x[i].far) / 2;
        }
        ok = sample_set_ask(s, at, n, e);
        for (int64_t i = 0; ok && i < n; i++) {
            int32_t middle = (x[i].near + x[i].far) / 2;
            bool worse = sample_set_find(s, at + SAMPLE_AXES_MAX * i)->level >= x[i].worse;
            if (x[i].far - x[i].near < 2) continue;
            if (worse == x[i].rising)
                x[i].far = middle;
            else
                x[i].near = middle;
        }
    }
    for (int64_t i = 0; ok && i < n; i++) m->edge[x[i].axis][x[i].node] = (x[i].near + x[i].far) / 2.0;
    free(at);
    free(x);
    return ok;
}

bool feasible_map_find(sample_set *s, const feasible_map_params *p, feasible_map *out, err *e)
{
    assert(p->axis_count == 2 || p->axis_count == 3);
    feasible_map m = {.params = *p, .node_count = 1, .example = -1};
    for (int k = 0; k < 3; k++) {
        bool used = k < p->axis_count;
        assert(!used || (p->low[k] % p->spacing == 0 && p->high[k] % p->spacing == 0 && p->low[k] < p->high[k]));
        m.count[k] = used ? (p->high[k] - p->low[k]) / p->spacing + 1 : 1;
        m.node_count *= m.count[k];
    }
    m.node = NEW_ARRAY(verdict, m.node_count);
    m.judged = NEW_ARRAY(uint8_t, m.node_count);
    m.behind = NEW_ARRAY(uint8_t, m.node_count);
    bool ok = refine(s, &m, e) && (!p->edges || find_edges(s, &m, e)) && feasible_map_look_behind(s, &m, e);
    for (int64_t a = 0; ok && a < m.node_count; a++) m.level_count[m.node[a].level]++;
    if (ok)
        *out = m;
    else
        feasible_map_free(&m);
    return ok;
}

void feasible_map_free(feasible_map *m)
{
    free(m->node);
    free(m->judged);
    free(m->behind);
    for (int k = 0; k < 2; k++) free(m->edge[k]);
    *m = (feasible_map){0};
}
