#include "sim/src/actuation/target_term.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <float.h>
#include <stdlib.h>

enum { POINT_GRAIN = 256, OWNER_GRAIN = 512 };

struct target_pull {
    const targets *t;
    const tetmesh *m;
    /* points on each node: source = 4 point + corner; on each pair of the assembly: source = 16 point + 4 corner of its
     * first node + corner of its second */
    int32_t node_count, edge_count;
    int32_t *node_start, *node_source, *edge_start, *edge_source;
    double *pull, *energy; /* [3*count], [count] of each point, mN and uJ */
};

/* start[owners + 1] and source[count] by owner[count], in their own order. */
static void sort_by_owner(const int32_t *owner, const int32_t *value, int32_t count, int32_t owners, int32_t *start,
                          int32_t *source)
{
    for (int32_t i = 0; i < count; i++) start[owner[i] + 1]++;
    for (int32_t i = 0; i < owners; i++) start[i + 1] += start[i];
    int32_t *next = COPY_ARRAY(int32_t, start, owners);
    for (int32_t i = 0; i < count; i++) source[next[owner[i]]++] = value[i];
    free(next);
}

target_pull *target_pull_make(const targets *t, const tetmesh *m, const assembly *a)
{
    target_pull *p = NEW_ARRAY(target_pull, 1);
    size_t n = (size_t)t->count;
    *p = (target_pull){.t = t,
                       .m = m,
                       .node_count = a->node_count,
                       .edge_count = a->edge_count,
                       .node_start = NEW_ARRAY(int32_t, (size_t)a->node_count + 1),
                       .node_source = NEW_ARRAY(int32_t, 4 * n),
                       .edge_start = NEW_ARRAY(int32_t, (size_t)a->edge_count + 1),
                       .edge_source = NEW_ARRAY(int32_t, 10 * n),
                       .pull = NEW_ARRAY(double, 3 * n),
                       .energy = NEW_ARRAY(double, n)};
    int32_t *owner = NEW_ARRAY(int32_t, 10 * n), *value = NEW_ARRAY(int32_t, 10 * n), count = 0;
    for (int32_t k = 0; k < t->count; k++)
        for (int32_t c = 0; c < 4; c++) {
            owner[count] = m->tet[4 * (size_t)t->tet[k] + (size_t)c];
            value[count++] = 4 * k + c;
        }
    sort_by_owner(owner, value, count, a->node_count, p->node_start, p->node_source);
    count = 0;
    for (int32_t k = 0; k < t->count; k++)
        for (int32_t c = 0; c < 4; c++)
            for (int32_t d = c; d < 4; d++) {
                const int32_t *tet = m->tet + 4 * (size_t)t->tet[k];
                bool turned = tet[c] > tet[d];
                owner[count] = assembly_edge(a, turned ? tet[d] : tet[c], turned ? tet[c] : tet[d]);
                value[count++] = 16 * k + (turned ? 4 * d + c : 4 * c + d);
            }
    sort_by_owner(owner, value, count, a->edge_count, p->edge_start, p->edge_source);
    free(owner);
    free(value);
    return p;
}

void target_pull_free(target_pull **p)
{
    if (!*p) return;
    free((*p)->node_start);
    free((*p)->node_source);
    free((*p)->edge_start);
    free((*p)->edge_source);
    free((*p)->pull);
    free((*p)->energy);
    free(*p);
    *p = NULL;
}

typedef struct pull_job {
    target_pull *p;
    const double *x;
    double *force;
    assembly *a;
} pull_job;

/* Off the place, along the normal in units of mm. */
static double point_off(const target_pull *p, const double *x, int32_t k, double d[3])
{
    targets_point(p->t, p->m, x, k, d);
    vec_sub(d, p->t->place + 3 * (size_t)k, d);
    return vec_dot(d, p->t->normal + 3 * (size_t)k);
}

static void point_body(int64_t begin, int64_t end, void *context)
{
    const pull_job *job = context;
    target_pull *p = job->p;
    for (int64_t k = begin; k < end; k++) {
        double d[3], s = p->t->stiffness[k], a = p->t->across[k], off = point_off(p, job->x, (int32_t)k, d);
        p->energy[k] = s / 2 * (a * vec_dot(d, d) + (1 - a) * off * off);
        vec_scale(d, s * a, p->pull + 3 * k);
        vec_axpy(p->pull + 3 * k, s * (1 - a) * off, p->t->normal + 3 * k, p->pull + 3 * k);
    }
}

static void node_body(int64_t begin, int64_t end, void *context)
{
    const pull_job *job = context;
    const target_pull *p = job->p;
    for (int64_t v = begin; v < end; v++)
        for (int32_t i = p->node_start[v]; i < p->node_start[v + 1]; i++) {
            size_t source = (size_t)p->node_source[i];
            vec_axpy(job->force + 3 * v, p->t->weight[source], p->pull + 3 * (source / 4), job->force + 3 * v);
        }
}

static double energy(void *self, const double *x, double *force)
{
    target_pull *p = self;
    pull_job job = {.p = p, .x = x, .force = force};
    parallel_for(p->t->count, POINT_GRAIN, point_body, &job);
    if (force) parallel_for(p->node_count, OWNER_GRAIN, node_body, &job);
    double sum = 0;
    for (int32_t k = 0; k < p->t->count; k++) sum += p->energy[k];
    return sum;
}

static void edge_body(int64_t begin, int64_t end, void *context)
{
    const pull_job *job = context;
    const target_pull *p = job->p;
    for (int64_t i = begin; i < end; i++)
        for (int32_t j = p->edge_start[i]; j < p->edge_start[i + 1]; j++) {
            size_t source = (size_t)p->edge_source[j], k = source / 16;
            const double *w = p->t->weight + 4 * k, *n = p->t->normal + 3 * k;
            double s = p->t->stiffness[k] * w[source / 4 % 4] * w[source % 4], a = p->t->across[k];
            double *block = job->a->edge_block + 9 * i;
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) block[3 * r + c] += s * ((r == c) * a + (1 - a) * n[r] * n[c]);
        }
}

static void stiffness(void *self, const double *x, const double *force, projection how, assembly *a)
{
    (void)x, (void)force, (void)how;
    target_pull *p = self;
    pull_job job = {.p = p, .a = a};
    parallel_for(p->edge_count, OWNER_GRAIN, edge_body, &job);
}

term target_term(target_pull *p) { return (term){.self = p, .energy = energy, .stiffness = stiffness}; }

double target_pull_longest(const target_pull *p, const double *x)
{
    double longest = 0;
    for (int32_t k = 0; k < p->t->count; k++) {
        double d[3];
        if (!(p->t->stiffness[k] > 0)) continue;
        double off = fabs(point_off(p, x, k, d));
        longest = fmax(longest, p->t->across[k] > 0 ? vec_norm(d) : off);
    }
    return longest;
}

/* Of one point's place. */
static double rounding_mm(const target_pull *p, const double *x, int32_t k)
{
    double at[3];
    targets_point(p->t, p->m, x, k, at);
    return DBL_EPSILON * (vec_norm(at) + vec_norm(p->t->place + 3 * (size_t)k));
}

double target_pull_force_noise(const target_pull *p, const double *x)
{
    double sum = 0;
    for (int32_t k = 0; k < p->t->count; k++) {
        double f = p->t->stiffness[k] * rounding_mm(p, x, k);
        sum += f * f;
    }
    return sqrt(sum);
}

double target_pull_energy_noise(const target_pull *p, const double *x)
{
    double sum = 0;
    for (int32_t k = 0; k < p->t->count; k++) {
        double d[3];
        point_off(p, x, k, d);
        sum += p->t->stiffness[k] * vec_norm(d) * rounding_mm(p, x, k);
    }
    return sum;
}
