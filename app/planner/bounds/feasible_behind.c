/* Is the set star-shaped about the base? */
#include "app/planner/bounds/feasible_parts.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int32_t common_divisor(int32_t a, int32_t b) { return b ? common_divisor(b, a % b) : abs(a); }

/* A stopped node on the ray to the node before it is reached; steps[3] of it from the base. */
static bool node_before(const feasible_map *m, const int32_t base[3], const int32_t d[3], int32_t steps[3])
{
    int32_t g = common_divisor(common_divisor(d[0], d[1]), d[2]);
    for (int32_t n = 1; n < g; n++) {
        int32_t i[3];
        for (int k = 0; k < 3; k++) i[k] = base[k] + n * (d[k] / g);
        if (m->node[node_at(m, i)].level != VERDICT_STOP) continue;
        for (int k = 0; k < 3; k++) steps[k] = (i[k] - base[k]) * m->params.spacing;
        return true;
    }
    return false;
}

static const double suspect = 0.2; /* share of stopped corners around a point above which it is judged */

/* How much of a point between nodes is stopped, 0 to 1: linear between the corners of its cell. */
static double stopped_share(const feasible_map *m, const double x[3])
{
    double share = 0;
    for (int c = 0; c < 1 << m->params.axis_count; c++) {
        int32_t corner[3] = {0};
        double weight = 1;
        for (int k = 0; k < m->params.axis_count; k++) {
            int32_t i = (int32_t)x[k] < m->count[k] - 1 ? (int32_t)x[k] : m->count[k] - 2;
            corner[k] = i + (c >> k & 1);
            weight *= c >> k & 1 ? x[k] - i : i + 1 - x[k];
        }
        if (m->node[node_at(m, corner)].level == VERDICT_STOP) share += weight;
    }
    return share;
}

/* The place on the ray before the node that is most likely stopped, to the nearest step; false if none may be. */
static bool place_before(const feasible_map *m, const int32_t base[3], const int32_t d[3], int32_t steps[3])
{
    int32_t far = 0;
    double most = suspect;
    for (int k = 0; k < 3; k++) far = abs(d[k]) > far ? abs(d[k]) : far;
    for (int32_t n = 1; n < 4 * far; n++) {
        double t = n / (4.0 * far), x[3];
        for (int k = 0; k < 3; k++) x[k] = base[k] + t * d[k];
        double share = stopped_share(m, x);
        if (share <= most) continue;
        most = share;
        for (int k = 0; k < 3; k++) steps[k] = (int32_t)lround(t * d[k] * m->params.spacing);
    }
    return most > suspect;
}

bool feasible_map_look_behind(sample_set *s, feasible_map *m, err *e)
{
    int32_t base[3] = {0}, steps[3];
    for (int k = 0; k < m->params.axis_count; k++) base[k] = -m->params.low[k] / m->params.spacing;
    m->base_stopped = m->node[node_at(m, base)].level == VERDICT_STOP;
    if (m->base_stopped) return true;
    int64_t *node = NEW_ARRAY(int64_t, m->node_count), n = 0;
    int32_t *at = NEW_ARRAY(int32_t, SAMPLE_AXES_MAX * m->node_count);
    for (int64_t a = 0; a < m->node_count; a++) {
        int32_t i[3], d[3];
        if (m->node[a].level == VERDICT_STOP) continue;
        node_index(m, a, i);
        for (int k = 0; k < 3; k++) d[k] = i[k] - base[k];
        if (!node_before(m, base, d, steps) && !place_before(m, base, d, steps)) continue;
        for (int k = 0; k < m->params.axis_count; k++) at[SAMPLE_AXES_MAX * n + m->params.axis[k]] = steps[k];
        node[n++] = a;
    }
    bool ok = sample_set_ask(s, at, n, e);
    for (int64_t i = 0; ok && i < n; i++) {
        const int32_t *before = at + SAMPLE_AXES_MAX * i;
        if (sample_set_find(s, before)->level != VERDICT_STOP) continue;
        m->behind[node[i]] = 1;
        if (m->behind_count++) continue;
        m->example = node[i];
        memcpy(m->before, before, sizeof m->before);
    }
    free(node);
    free(at);
    return ok;
}
