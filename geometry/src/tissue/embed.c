#include "geometry/embed.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>

/* Tets sorted into cubes: list[start[c] .. start[c+1]) holds the tets whose bounding box meets cube c. */
typedef struct cubes {
    double low[3], edge_mm;
    int32_t size[3], *list;
    int64_t *start;
} cubes;

static const double *corner(const tetmesh *m, int32_t t, int k)
{
    return m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)k];
}

static void cube_range(const cubes *c, const double low[3], const double high[3], int32_t from[3], int32_t to[3])
{
    for (int k = 0; k < 3; k++) {
        double a = floor((low[k] - c->low[k]) / c->edge_mm), b = floor((high[k] - c->low[k]) / c->edge_mm);
        from[k] = (int32_t)fmax(0, a);
        to[k] = (int32_t)fmin(c->size[k] - 1, b);
    }
}

static void tet_box(const tetmesh *m, int32_t t, double low[3], double high[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = HUGE_VAL;
        high[c] = -HUGE_VAL;
        for (int k = 0; k < 4; k++) {
            low[c] = fmin(low[c], corner(m, t, k)[c]);
            high[c] = fmax(high[c], corner(m, t, k)[c]);
        }
    }
}

static cubes sort_into_cubes(const tetmesh *m, double edge_mm)
{
    cubes c = {.edge_mm = edge_mm};
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int32_t v = 0; v < m->vertex_count; v++)
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], m->xyz[3 * (size_t)v + (size_t)k]);
            high[k] = fmax(high[k], m->xyz[3 * (size_t)v + (size_t)k]);
        }
    int64_t count = 1;
    for (int k = 0; k < 3; k++) {
        c.low[k] = low[k];
        c.size[k] = (int32_t)floor((high[k] - low[k]) / edge_mm) + 1;
        count *= c.size[k];
    }
    c.start = NEW_ARRAY(int64_t, count + 1);
    for (int pass = 0; pass < 2; pass++) { /* count, then fill */
        for (int32_t t = 0; t < m->tet_count; t++) {
            double lo[3], hi[3];
            int32_t from[3], to[3];
            tet_box(m, t, lo, hi);
            cube_range(&c, lo, hi, from, to);
            for (int32_t k = from[2]; k <= to[2]; k++)
                for (int32_t j = from[1]; j <= to[1]; j++)
                    for (int32_t i = from[0]; i <= to[0]; i++) {
                        int64_t at = i + (int64_t)c.size[0] * (j + (int64_t)c.size[1] * k);
                        if (pass)
                            c.list[c.start[at]++] = t;
                        else
                            c.start[at]++;
                    }
        }
        int64_t sum = 0;
        if (pass) /* start[] ran on to the ends: shift back */
            for (int64_t at = count; at > 0; at--) c.start[at] = c.start[at - 1];
        else
            for (int64_t at = 0; at <= count; at++) {
                int64_t here = c.start[at];
                c.start[at] = sum;
                sum += here;
            }
        if (pass)
            c.start[0] = 0;
        else
            c.list = NEW_ARRAY(int32_t, sum);
    }
    return c;
}

static void barycentric(const double *const x[4], const double p[3], double w[4])
{
    double whole = vec_six_volume(x[0], x[1], x[2], x[3]);
    w[0] = vec_six_volume(p, x[1], x[2], x[3]) / whole;
    w[1] = vec_six_volume(x[0], p, x[2], x[3]) / whole;
    w[2] = vec_six_volume(x[0], x[1], p, x[3]) / whole;
    w[3] = 1 - w[0] - w[1] - w[2];
}

/* Squared distance from p to segment ab. */
static double segment_distance2(const double a[3], const double b[3], const double p[3])
{
    double ab[3], ap[3], at[3];
    vec_sub(b, a, ab);
    vec_sub(p, a, ap);
    double l = vec_dot(ab, ab), s = l > 0 ? fmax(0, fmin(1, vec_dot(ap, ab) / l)) : 0;
    vec_axpy(a, s, ab, at);
    vec_sub(p, at, at);
    return vec_dot(at, at);
}

/* Squared distance from p to triangle abc. */
static double triangle_distance2(const double a[3], const double b[3], const double c[3], const double p[3])
{
    double u[3], v[3], n[3], q[3];
    vec_sub(b, a, u);
    vec_sub(c, a, v);
    vec_sub(p, a, q);
    vec_cross(u, v, n);
    double nn = vec_dot(n, n);
    if (nn > 0) {
        double uq[3], qv[3];
        vec_cross(u, q, uq);
        vec_cross(q, v, qv);
        double g = vec_dot(uq, n) / nn, b1 = vec_dot(qv, n) / nn;
        if (g >= 0 && b1 >= 0 && g + b1 <= 1) {
            double h = vec_dot(q, n);
            return h * h / nn;
        }
    }
    return fmin(segment_distance2(a, b, p), fmin(segment_distance2(b, c, p), segment_distance2(c, a, p)));
}

static double tet_distance2(const double *const x[4], const double p[3], const double w[4])
{
    if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0 && w[3] >= 0) return 0;
    double best = HUGE_VAL;
    for (int k = 0; k < 4; k++)
        if (w[k] < 0) best = fmin(best, triangle_distance2(x[tet_face[k][0]], x[tet_face[k][1]], x[tet_face[k][2]], p));
    return best;
}

typedef struct search {
    const tetmesh *m;
    const cubes *c;
    const double *xyz;
    double reach_mm, *gap;
    embed_allowed *allowed;
    void *context;
    embedding *out;
} search;

/* Best tet among the cubes within `ring` of the point; ties go to the lower number. */
static double search_ring(const search *s, int32_t point, double ring, int32_t *best, double best_w[4])
{
    const double *p = s->xyz + 3 * (size_t)point;
    double lo[3], hi[3], d2 = HUGE_VAL;
    int32_t from[3], to[3];
    for (int k = 0; k < 3; k++) {
        lo[k] = p[k] - ring;
        hi[k] = p[k] + ring;
    }
    cube_range(s->c, lo, hi, from, to);
    for (int32_t k = from[2]; k <= to[2]; k++)
        for (int32_t j = from[1]; j <= to[1]; j++)
            for (int32_t i = from[0]; i <= to[0]; i++) {
                int64_t at = i + (int64_t)s->c->size[0] * (j + (int64_t)s->c->size[1] * k);
                for (int64_t n = s->c->start[at]; n < s->c->start[at + 1]; n++) {
                    int32_t t = s->c->list[n];
                    if (s->allowed && !s->allowed(point, t, s->context)) continue;
                    const double *x[4] = {corner(s->m, t, 0), corner(s->m, t, 1), corner(s->m, t, 2),
                                          corner(s->m, t, 3)};
                    double w[4];
                    barycentric(x, p, w);
                    double d = tet_distance2(x, p, w);
                    if (d < d2 || (d == d2 && t < *best)) {
                        d2 = d;
                        *best = t;
                        for (int a = 0; a < 4; a++) best_w[a] = w[a];
                    }
                }
            }
    return sqrt(d2);
}

static void search_points(int64_t begin, int64_t end, void *context)
{
    const search *s = context;
    for (int64_t i = begin; i < end; i++) {
        int32_t best = -1;
        double w[4] = {0}, d = search_ring(s, (int32_t)i, 0, &best, w);
        /* a near miss may have a nearer tet in the next cubes */
        for (double ring = s->c->edge_mm / 2; d > 0 && ring < 2 * s->reach_mm; ring *= 2) {
            d = search_ring(s, (int32_t)i, fmin(ring, s->reach_mm), &best, w);
            if (d <= ring) break;
        }
        if (d > s->reach_mm) best = -1;
        s->out->tet[i] = best;
        s->gap[i] = d;
        for (int a = 0; a < 4; a++) s->out->weight[4 * i + a] = best < 0 ? 0 : w[a];
    }
}

embedding embed_points(const tetmesh *m, const double *xyz, int32_t count, double reach_mm, embed_allowed *allowed,
                       void *context)
{
    embedding out = {
        .point_count = count, .tet = NEW_ARRAY(int32_t, count), .weight = NEW_ARRAY(double, 4 * (size_t)count)};
    cubes c = sort_into_cubes(m, 4);
    search s = {m, &c, xyz, reach_mm, NEW_ARRAY(double, count), allowed, context, &out};
    parallel_for(count, 256, search_points, &s);
    int32_t carried = 0;
    for (int32_t i = 0; i < count; i++) {
        if (out.tet[i] < 0) continue;
        carried++;
        out.mean_gap_mm += s.gap[i];
        out.max_gap_mm = fmax(out.max_gap_mm, s.gap[i]);
    }
    if (carried) out.mean_gap_mm /= carried;
    free(s.gap);
    free(c.list);
    free(c.start);
    return out;
}

void embedding_free(embedding *e)
{
    free(e->tet);
    free(e->weight);
    *e = (embedding){0};
}

void embedding_apply(const embedding *e, const tetmesh *m, const double *u, const double *xyz, double *out)
{
    for (int32_t i = 0; i < e->point_count; i++)
        for (size_t c = 0; c < 3; c++) {
            double sum = xyz[3 * (size_t)i + c];
            if (e->tet[i] >= 0)
                for (size_t k = 0; k < 4; k++)
                    sum += e->weight[4 * (size_t)i + k] * u[3 * (size_t)m->tet[4 * (size_t)e->tet[i] + k] + c];
            out[3 * (size_t)i + c] = sum;
        }
}
