/* Between neighbouring rays the rim of what the tissue allows runs straight. */
#include "app/planner/bounds/audit.h"
#include "geometry/mem.h"
#include <math.h>
#include <string.h>

/* p = sum w[k] v[k] of two or three vectors; false if they lie in a line or plane. */
static bool weights(int n, const double v[3][3], const double p[3], double w[3])
{
    double m[3][3], det;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) m[r][c] = c < n && r < n ? v[c][r] : r == c;
    det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    if (fabs(det) < 1e-9) return false;
    for (int k = 0; k < n; k++) {
        double q[3][3];
        memcpy(q, m, sizeof q);
        for (int r = 0; r < 3; r++) q[r][k] = r < n ? p[r] : 0;
        w[k] = (q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[2][1]) - q[0][1] * (q[1][0] * q[2][2] - q[1][2] * q[2][0]) +
                q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0])) /
               det;
    }
    return true;
}

/* Whether p (steps from the base) lies inside (0) the rim that neighbouring rays span, outside of one where the tissue
 * limits a ray (1, *stop: whose stop counts), or outside of one where it limits none (2). The rays of a cone: along one
 * axis of the box, to the middle of a side or an edge, to a corner. */
static int look(const audit *a, int request, const double p[3], const audit_ray **stop)
{
    static const int power[3] = {1, 3, 9};
    const audit_request *q = &a->settings.request[request];
    int n = q->axis_count;
    for (int first = 0; first < n; first++)
        for (int second = 0; second < n; second++) {
            if (second == first) continue;
            int order[3] = {first, second, 3 - first - second}, d = 0;
            const audit_ray *ray[3];
            double v[3][3] = {{0}}, w[3], sum = 0, most = -1;
            bool inside = true;
            for (int k = 0; k < n; k++) {
                d += power[order[k]] * (p[order[k]] < 0 ? 1 : 2);
                ray[k] = &a->ray[a->request_ray[request][d]];
                double share = fmax(ray[k]->reach, 0.25) / ray[k]->steps;
                for (int c = 0; c < n; c++) v[k][c] = share * ray[k]->target[q->axis[c]];
            }
            if (!weights(n, (const double(*)[3])v, p, w)) continue;
            *stop = NULL;
            for (int k = 0; k < n; k++) {
                inside &= w[k] >= -1e-9;
                sum += w[k];
                if (!ray[k]->limited || w[k] <= most) continue;
                most = w[k];
                *stop = ray[k];
            }
            if (inside) return sum <= 1 + 1e-9 ? 0 : *stop ? 1 : 2;
        }
    return 0;
}

static void mark_edges(const audit *a, int request, feasible_map *m)
{
    const uint8_t *outside = a->outside[request];
    const audit_ray *stop;
    for (int k = 0; k < 2 && m->edge[k]; k++)
        for (int64_t i = 0; i < m->node_count; i++) {
            int32_t at[SAMPLE_AXES_MAX];
            int64_t next = i + (k ? m->count[0] : 1);
            if (k ? next >= m->node_count : i % m->count[0] == m->count[0] - 1) continue;
            if ((outside[i] == 1) == (outside[next] == 1) || m->node[i].level == m->node[next].level) continue;
            double p[3] = {0}, low = 0, high = m->params.spacing;
            feasible_map_place(m, i, at);
            for (int c = 0; c < 2; c++) p[c] = at[m->params.axis[c]];
            double from = p[k];
            for (int n = 0; n < 20; n++) {
                p[k] = from + (low + high) / 2;
                bool beyond = look(a, request, p, &stop) == 1;
                *(beyond == (outside[i] == 1) ? &low : &high) = (low + high) / 2;
            }
            m->edge[k][i] = (low + high) / 2;
        }
}

void audit_rim_mark(audit *a, int request)
{
    feasible_map *m = &a->map[request];
    const audit_ray *r;
    a->outside[request] = NEW_ARRAY(uint8_t, m->node_count);
    for (int64_t i = 0; i < m->node_count; i++) {
        int32_t at[SAMPLE_AXES_MAX];
        double p[3] = {0};
        if (m->node[i].level == VERDICT_STOP) continue;
        feasible_map_place(m, i, at);
        for (int c = 0; c < m->params.axis_count; c++) p[c] = at[m->params.axis[c]];
        a->outside[request][i] = (uint8_t)look(a, request, p, &r);
        if (a->outside[request][i] != 1) continue;
        m->level_count[m->node[i].level]--;
        m->level_count[VERDICT_STOP]++;
        m->node[i] = r->v;
        m->behind_count -= m->behind[i];
        m->behind[i] = 0;
    }
    mark_edges(a, request, m);
}
