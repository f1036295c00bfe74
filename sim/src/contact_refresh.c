#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "sim/src/contact_state.h"

enum { NODE_GRAIN = 16, most_turns = 6 /* between both sides of a thin bone, before a node is given up */ };

static const double shallow = 0.4;    /* of h: what the plain support sees well */
static const double wide = 1 / 0.4;   /* support of a deep node over its distance; meets 1 at shallow */
static const double deep_mm = 0.3;    /* in a shape: a node whose way back is not found is given up from here on */
static const double backwards = -0.2; /* cosine to the way that a node came from, of a nearest surface that is the wrong one */
static const double candidate_mm = 2; /* samples so far beyond the support are kept as candidates */

/* Where the node is seen by the collider, and the direction a sample must face. */
static void look(const contact *c, int32_t i, const contact_link *link, const double *x, double at[3],
                 double facing[3])
{
    vec_copy(x + 3 * (size_t)c->node[i], at);
    if (is_lip(link)) {
        int own = link->collider == COLLIDER_UPPER ? COLLIDER_LOWER : COLLIDER_UPPER;
        vec_scale(c->cloud[own].n + 3 * (size_t)c->own_sample[i], -1, facing);
        return;
    }
    rigid_rotate(&c->guide, c->outward + 3 * (size_t)i, facing);
    rigid_rotate(&c->back[link->collider], facing, facing);
    vec_scale(facing, -1, facing);
    rigid_apply(&c->back[link->collider], at, at);
}

static void refresh_link(contact *c, int32_t i, contact_link *link, const double *x)
{
    const imls_cloud *cloud = &c->cloud[link->collider];
    double at[3], facing[3], best = HUGE_VAL;
    int32_t nearest = -1;
    look(c, i, link, x, at, facing);
    link->near = link->lost = false;
    link->scale = 1;
    link->count = 0;
    link->plane_mm = HUGE_VAL;
    for (int32_t s = 0; s < cloud->count; s++) {
        double r[3];
        vec_sub(at, cloud->x + 3 * (size_t)s, r);
        double square = vec_dot(r, r);
        if (square >= best || vec_dot(cloud->n + 3 * (size_t)s, facing) < c->setup.params.facing_cos)
            continue;
        best = square;
        nearest = s;
    }
    if (nearest < 0) return;
    double r[3], h = cloud->h[nearest], distance = sqrt(best);
    vec_sub(at, cloud->x + 3 * (size_t)nearest, r);
    link->plane_mm = vec_dot(cloud->n + 3 * (size_t)nearest, r);
    double aside = sqrt(fmax(0, best - link->plane_mm * link->plane_mm));
    link->aside = aside / h;
    double depth = -link->plane_mm;
    if (depth > shallow * h && aside <= fmax(h, distance / 2) && link->faced) {
        link->lost = depth > c->motion_reach_mm + shallow * h;
        if (link->lost) return;
        link->scale = wide * depth / h;
    }
    for (int32_t s = 0; s < cloud->count; s++) {
        vec_sub(at, cloud->x + 3 * (size_t)s, r);
        double reach = link->scale * cloud->h[s] + candidate_mm;
        if (vec_dot(r, r) >= reach * reach ||
            vec_dot(cloud->n + 3 * (size_t)s, facing) < c->setup.params.facing_cos)
            continue;
        if (link->count == link->room) {
            link->room = 2 * link->room + 16;
            link->sample = GROW_ARRAY(int32_t, link->sample, link->room);
            if (is_lip(link)) link->weight = GROW_ARRAY(double, link->weight, link->room);
        }
        link->sample[link->count++] = s;
    }
    link->near = link->count > 0;
    if (!link->near) return;
    imls_value v =
        imls_at(cloud, link->sample, link->count, link->scale, at, false, is_lip(link) ? link->weight : NULL);
    link->cover = imls_cover(v.S);
    link->near = link->cover > 0;
    if (!link->near || !is_lip(link)) return;
    vec_copy(v.grad, link->m);
    link->base = v.d - vec_dot(v.grad, at);
    int32_t kept = 0;
    for (int32_t k = 0; k < link->count; k++) { /* mere candidates are of no use here */
        if (!(link->weight[k] > 0)) continue;
        link->base += link->weight[k] * vec_dot(v.grad, cloud->x + 3 * (size_t)link->sample[k]);
        link->sample[kept] = link->sample[k];
        link->weight[kept++] = link->weight[k];
    }
    link->count = kept;
}

/* The plane at which the way back to where the node came from leaves the bone. The node cannot have gone farther into
 * it than it went; a bone that lies behind the tissue at rest too was not passed. */
static bool find_way_back(const contact *c, int32_t i, contact_link *link, const double at[3], const double facing[3])
{
    const bone_shape *shape = c->setup.shape[link->collider];
    const double *rest = c->rest_xyz + 3 * (size_t)c->node[i];
    double hit[3], rest_hit[3], rest_normal[3], rest_facing[3], gone = vec_distance(at, rest);
    if (!shape->leave(shape->context, at, facing, gone + deep_mm, hit, link->m)) return false;
    if (!(vec_dot(link->m, facing) > -backwards)) return false;
    vec_scale(c->outward + 3 * (size_t)i, -1, rest_facing);
    if (shape->leave(shape->context, rest, rest_facing, vec_distance(hit, at) + deep_mm, rest_hit, rest_normal) &&
        vec_distance(rest, rest_hit) > deep_mm) /* else its own surface */
        return false;
    link->base = -vec_dot(link->m, hit);
    return true;
}

/* A shape knows its inside, but of a thin bone not the side from which the node came: where a node would be pushed on
 * the way that it went, it sees the plane at its way back. Right through a bone it goes unseen. */
static void refresh_shape_link(contact *c, int32_t i, contact_link *link, const double *x)
{
    const bone_shape *shape = c->setup.shape[link->collider];
    double at[3], facing[3], grad[3];
    look(c, i, link, x, at, facing);
    link->plane_mm = HUGE_VAL;
    link->scale = link->cover = 1;
    double d = shape->distance(shape->context, at, grad, NULL);
    bool wrong = d < 0 && vec_dot(grad, facing) <= backwards * vec_norm(grad);
    bool before = link->flat;
    link->flat = wrong && find_way_back(c, i, link, at, facing);
    link->turns += link->flat != before;
    link->lost = (wrong && !link->flat && d < -deep_mm) || link->turns > most_turns;
    link->flat = link->flat && !link->lost;
    link->near = link->flat || (d < HUGE_VAL && !link->lost);
}

/* Outside, but its straight way there leads through the bone, and so does the way that it should be pushed. */
static bool has_passed(const contact *c, int32_t i, const contact_link *link, const double *x)
{
    static const double least_mm = 0.5; /* of a move that can lead through a bone */
    const bone_shape *shape = is_lip(link) ? NULL : c->setup.shape[link->collider];
    double at[3], facing[3], back[3], hit[3], normal[3], grad[3];
    contact_link own = *link;
    if (!shape || link->flat) return false;
    look(c, i, link, x, at, facing);
    vec_sub(c->rest_xyz + 3 * (size_t)c->node[i], at, back);
    double gone = vec_normalize(back);
    return gone > least_mm && shape->distance(shape->context, at, grad, NULL) >= 0 &&
           shape->leave(shape->context, at, back, gone, hit, normal) && find_way_back(c, i, &own, at, facing);
}

int32_t contact_passed(const contact *c, const double *x)
{
    int32_t count = 0;
    for (int32_t i = 0; i < c->node_count; i++) {
        bool passed = false;
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) passed = passed || has_passed(c, i, &c->link[l], x);
        count += passed;
    }
    return count;
}

typedef struct refresh_job {
    contact *c;
    const double *x;
} refresh_job;

static void refresh_body(int64_t begin, int64_t end, void *context)
{
    const refresh_job *job = context;
    contact *c = job->c;
    for (int64_t i = begin; i < end; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            c->link[l].delta_before = c->link[l].delta;
            contact_link *link = &c->link[l];
            if (link->left_out) continue;
            if (!is_lip(link) && c->setup.shape[link->collider])
                refresh_shape_link(c, (int32_t)i, link, job->x);
            else
                refresh_link(c, (int32_t)i, link, job->x);
        }
}

void contact_refresh(contact *c, const double *x)
{
    for (int side = 0; side < 2; side++) {
        imls_cloud *cloud = &c->cloud[COLLIDER_UPPER + side];
        for (int32_t i = 0; i < cloud->count; i++)
            vec_copy(x + 3 * (size_t)c->lip_node[side][i], cloud->x + 3 * (size_t)i);
        if (cloud->count) imls_shape(cloud, c->lip_tri[side], c->lip_tri_count[side], 0);
    }
    refresh_job job = {.c = c, .x = x};
    parallel_for(c->node_count, NODE_GRAIN, refresh_body, &job);
    c->report.refreshes++;
}

double contact_refresh_change(const contact *c)
{
    double worst = 0;
    for (int32_t l = 0; l < c->link_count; l++)
        worst = fmax(worst, fabs(c->link[l].delta - c->link[l].delta_before));
    return worst;
}
