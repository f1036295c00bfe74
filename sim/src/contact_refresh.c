#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include "sim/src/contact_state.h"

enum { NODE_GRAIN = 16, most_turns = 6 /* between both sides of a thin bone, before a node is given up */ };

static const double deep_mm = 0.3;    /* in a shape: a node whose way back is not found is given up from here on */
static const double backwards = -0.2; /* cosine to the way that a node came from, of a nearest surface that is the wrong one */

/* Where the node is in the bone's place at rest, and the direction that the bone's surface must face. */
static void look(const contact *c, int32_t i, const contact_link *link, const double *x, double at[3],
                 double facing[3])
{
    rigid_rotate(&c->guide, c->outward + 3 * (size_t)i, facing);
    rigid_rotate(&c->back[link->collider], facing, facing);
    vec_scale(facing, -1, facing);
    rigid_apply(&c->back[link->collider], x + 3 * (size_t)c->node[i], at);
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
            if (is_lip(link))
                contact_refresh_lip(c, (int32_t)i, link, job->x);
            else
                refresh_shape_link(c, (int32_t)i, link, job->x);
        }
}

void contact_refresh(contact *c, const double *x)
{
    contact_move_lips(c, x);
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
