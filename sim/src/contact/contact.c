#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <assert.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { NODE_GRAIN = 16 };

static const double shallow_depths = 6;

void contact_restart(contact *c)
{
    int32_t left_out = c->report.left_out;
    for (int32_t l = 0; l < c->link_count; l++) {
        c->link[l].stiffening = 1;
        c->link[l].off_mm = 0;
        c->link[l].turns = 0;
        if (c->link[l].guard) c->link[l].near = false;
    }
    c->report = (contact_report){.left_out = left_out};
}

void contact_move(contact *c, const rigid motion[SEGMENT_COUNT], const rigid *guide, const double *rest_xyz)
{
    c->guide = *guide;
    c->rest_xyz = rest_xyz;
    c->motion_reach_mm = 0;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        c->motion[s] = motion[s];
        c->back[s] = rigid_is_identity(&motion[s]) ? rigid_identity() : rigid_inverse(&motion[s]);
        for (int32_t i = 0; i < c->node_count; i++) {
            double p[3], q[3];
            rigid_apply(&motion[s], rest_xyz + 3 * (size_t)c->node[i], p);
            rigid_apply(guide, rest_xyz + 3 * (size_t)c->node[i], q);
            c->motion_reach_mm = fmax(c->motion_reach_mm, vec_distance(p, q));
        }
    }
}

typedef struct contact_job {
    contact *c;
    const double *x, *force;
    bool exact, shallow;
    double *block; /* [9*node_count] */
} contact_job;

static double stiffness_of(const contact *c, int32_t i, const contact_link *link)
{
    return c->area[i] * c->k * link->stiffening * (is_lip(link) ? 0.5 : 1); /* both lips see each contact */
}

static double lip_gap(const contact *c, int32_t i, const contact_link *link, const double *x)
{
    const int32_t *node = c->lip_node[link->collider - COLLIDER_UPPER];
    double gap = link->base + vec_dot(link->m, x + 3 * (size_t)c->node[i]);
    for (int32_t k = 0; k < link->count; k++)
        gap -= link->weight[k] * vec_dot(link->m, x + 3 * (size_t)node[link->sample[k]]);
    return gap;
}

double contact_bone_gap(const contact *c, const contact_link *link, const double at[3], double grad[3], double *hess)
{
    const bone_shape *shape = c->setup.shape[link->collider];
    if (link->flat) {
        vec_copy(link->m, grad);
        if (hess) memset(hess, 0, 9 * sizeof *hess);
        return link->base + vec_dot(link->m, at);
    }
    return shape->distance(shape->context, at, grad, hess) - link->off_mm;
}

/* Energy of one link; fills what belongs to the last evaluation. */
static double evaluate_link(const contact *c, int32_t i, contact_link *link, const double *x)
{
    link->gap = HUGE_VAL;
    link->delta = 0;
    memset(link->force, 0, sizeof link->force);
    if (!link->near || link->left_out) return 0;
    double push[3];
    if (is_lip(link)) {
        link->gap = lip_gap(c, i, link, x);
        vec_copy(link->m, push);
    } else {
        double at[3];
        rigid_apply(&c->back[link->collider], x + 3 * (size_t)c->node[i], at);
        link->gap = contact_bone_gap(c, link, at, push, NULL);
    }
    double delta = link->threshold_mm - link->gap, weight = stiffness_of(c, i, link) * link->cover;
    if (!(delta > 0)) return 0;
    link->delta = delta;
    vec_scale(push, -3 * weight * delta * delta, link->force);
    if (!is_lip(link)) rigid_rotate(&c->motion[link->collider], link->force, link->force);
    return weight * delta * delta * delta;
}

static void energy_body(int64_t begin, int64_t end, void *context)
{
    const contact_job *job = context;
    contact *c = job->c;
    for (int64_t i = begin; i < end; i++) {
        c->energy[i] = 0;
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
            c->energy[i] += evaluate_link(c, (int32_t)i, &c->link[l], job->x);
    }
}

double contact_energy(contact *c, const double *x, double *force)
{
    contact_job job = {.c = c, .x = x};
    parallel_for(c->node_count, NODE_GRAIN, energy_body, &job);
    double sum = 0;
    for (int32_t i = 0; i < c->node_count; i++) {
        sum += c->energy[i];
        for (int32_t l = c->link_start[i]; force && l < c->link_start[i + 1]; l++) {
            const contact_link *link = &c->link[l];
            if (!(link->delta > 0)) continue;
            double *f = force + 3 * (size_t)c->node[i];
            vec_add(f, link->force, f);
            for (int32_t k = 0; is_lip(link) && k < link->count; k++) {
                f = force + 3 * (size_t)c->lip_node[link->collider - COLLIDER_UPPER][link->sample[k]];
                vec_axpy(f, -link->weight[k], link->force, f);
            }
        }
    }
    return sum;
}

double contact_force_noise(const contact *c, const double *x)
{
    double sum = 0;
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            const contact_link *link = &c->link[l];
            double reach = vec_norm(x + 3 * (size_t)c->node[i]);
            double off = 6 * stiffness_of(c, i, link) * link->cover * link->delta * 4 * DBL_EPSILON * reach;
            sum += off * off;
        }
    return 4 * sqrt(sum);
}

/* Adds w m m^T for a pair of entries. */
static void add_outer(double *block, double w, const double m[3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) block[3 * a + b] += w * m[a] * m[b];
}

static void turn_hessian(const double R[9], const double hess[9], double turned[9])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            turned[3 * a + b] = 0;
            for (int p = 0; p < 3; p++)
                for (int q = 0; q < 3; q++) turned[3 * a + b] += R[3 * a + p] * hess[3 * p + q] * R[3 * b + q];
        }
}

/* A node on a curved level feels the curve: minus its reaction times the Hessian of the distance. */
static void add_level_curvature(const contact *c, int32_t i, const double *x, const double *force, double block[9])
{
    const bone_shape *shape = c->setup.shape[c->level_segment[i]];
    double at[3], m[3], hess[9], turned[9];
    size_t v = 3 * (size_t)c->node[i];
    rigid_apply(&c->back[c->level_segment[i]], x + v, at);
    if (!(shape->distance(shape->context, at, m, hess) < HUGE_VAL)) return;
    double square = vec_dot(m, m);
    rigid_rotate(&c->motion[c->level_segment[i]], m, m);
    if (!(square > 0.1)) return;
    turn_hessian(c->motion[c->level_segment[i]].r, hess, turned);
    for (int k = 0; k < 9; k++) block[k] -= vec_dot(force + v, m) / square * turned[k];
}

bool contact_is_deep(const contact *c, double delta) { return delta > shallow_depths * c->setup.params.depth_mm; }

/* Deep contacts bend the energy so much that curvature only misleads: it counts once all are shallow. */
static bool is_shallow(const contact *c)
{
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
            if (contact_is_deep(c, c->link[l].delta) && !contact_is_pinched(c, i)) return false;
    return true;
}

static void stiffness_body(int64_t begin, int64_t end, void *context)
{
    const contact_job *job = context;
    contact *c = job->c;
    for (int64_t i = begin; i < end; i++) {
        if (job->exact && job->shallow && c->level_segment[i] >= 0)
            add_level_curvature(c, (int32_t)i, job->x, job->force, job->block + 9 * i);
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            contact_link *link = &c->link[l];
            evaluate_link(c, (int32_t)i, link, job->x);
            link->delta_factored = link->delta;
            if (!(link->delta > 0) || is_lip(link)) continue;
            double at[3], m[3], hess[9], *block = job->block + 9 * i;
            rigid_apply(&c->back[link->collider], job->x + 3 * (size_t)c->node[i], at);
            contact_bone_gap(c, link, at, m, job->exact ? hess : NULL);
            double weight = stiffness_of(c, (int32_t)i, link) * link->cover;
            rigid_rotate(&c->motion[link->collider], m, m);
            add_outer(block, 6 * weight * link->delta, m);
            if (!job->exact || (c->setup.held && contact_is_deep(c, link->delta))) continue;
            double turned[9];
            turn_hessian(c->motion[link->collider].r, hess, turned);
            for (int k = 0; k < 9; k++) block[k] -= 3 * weight * link->delta * link->delta * turned[k];
        }
    }
}

static double *block_between(const assembly *a, int32_t u, int32_t v)
{
    return u < v ? assembly_block(a, u, v) : assembly_block(a, v, u);
}

/* w (m.x_i - sum weight m.x_k)^2 / 2. Where a pair is missing in the pattern, the diagonal bound
 * w (m.x_i)^2 + w sum weight (m.x_k)^2 instead: still positive, only slower. */
static void add_lip(contact *c, const assembly *a, int32_t i, const contact_link *link)
{
    const int32_t *name = c->lip_node[link->collider - COLLIDER_UPPER];
    double w = 6 * stiffness_of(c, i, link) * link->cover * link->delta;
    int32_t v = c->node[i];
    bool whole = true;
    for (int32_t k = 0; whole && k < link->count; k++) {
        int32_t p = name[link->sample[k]];
        whole = block_between(a, v, p) != NULL;
        for (int32_t j = 0; whole && j < k; j++) whole = block_between(a, p, name[link->sample[j]]) != NULL;
    }
    c->report.uncoupled += !whole;
    add_outer(assembly_block(a, v, v), whole ? w : 2 * w, link->m);
    for (int32_t k = 0; k < link->count; k++) {
        int32_t p = name[link->sample[k]];
        double share = link->weight[k];
        add_outer(assembly_block(a, p, p), whole ? w * share * share : 2 * w * share, link->m);
        if (!whole) continue;
        add_outer(block_between(a, v, p), -w * share, link->m);
        for (int32_t j = 0; j < k; j++)
            add_outer(block_between(a, p, name[link->sample[j]]), w * share * link->weight[j], link->m);
    }
}

void contact_stiffness(contact *c, const double *x, const double *force, bool exact, assembly *a)
{
    contact_job job = {.c = c,
                       .x = x,
                       .force = force,
                       .exact = exact,
                       .shallow = is_shallow(c),
                       .block = NEW_ARRAY(double, 9 * (size_t)c->node_count)};
    parallel_for(c->node_count, NODE_GRAIN, stiffness_body, &job);
    c->report.uncoupled = 0;
    for (int32_t i = 0; i < c->node_count; i++) {
        double *block = assembly_block(a, c->node[i], c->node[i]);
        c->around[i] = fmax(0, (block[0] + block[4] + block[8]) / 3);
        for (int k = 0; k < 9; k++) block[k] += job.block[9 * (size_t)i + (size_t)k];
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
            if (is_lip(&c->link[l]) && c->link[l].delta > 0) add_lip(c, a, i, &c->link[l]);
    }
    free(job.block);
}

bool contact_stiffness_is_old(const contact *c)
{
    for (int32_t l = 0; l < c->link_count; l++)
        if (fabs(c->link[l].delta - c->link[l].delta_factored) > c->setup.params.depth_mm / 4) return true;
    return false;
}
