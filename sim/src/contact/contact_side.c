/* On which side of a bone a node belongs: the one that it came from. */
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <math.h>
#include <stddef.h>

static const double deep_mm = 0.3; /* in a shape, as far as its surface may be from a node that lies on it */
static const double given_up_mm =
    1.5;                              /* in a shape: before, a node whose way back is not found leaves by the nearest */
static const double backwards = -0.2; /* cosine to the way back, of a nearest surface that is the wrong one */
static const double least_mm = 0.5;   /* of a move that can lead right through a bone */
static const double behind_mm = 0.3;  /* the bone's face on the way back, a guard's plane lies */
static const double edge_mm = 0.4; /* thinner bone is an edge round which a node can have turned; more than behind_mm */

/* Where the node is in the bone's place at rest, and the direction that the bone's surface must face. */
static void look(const contact *c, int32_t i, int32_t bone, const double *x, double at[3], double facing[3])
{
    rigid_rotate(&c->guide, c->outward + 3 * (size_t)i, facing);
    rigid_rotate(&c->back[bone], facing, facing);
    vec_scale(facing, -1, facing);
    rigid_apply(&c->back[bone], x + 3 * (size_t)c->node[i], at);
}

/* Where the way back to where the node came from leaves the bone. The node cannot have gone farther into it
 * than it went; a bone that lies behind the tissue at rest too was not passed. */
static bool find_way_back(const contact *c, int32_t i, int32_t bone, const double at[3], const double facing[3],
                          double hit[3], double normal[3])
{
    const bone_shape *shape = c->setup.shape[bone];
    const double *rest = c->rest_xyz + 3 * (size_t)c->node[i];
    double rest_hit[3], rest_normal[3], rest_facing[3], gone = vec_distance(at, rest);
    if (!shape->leave(shape->context, at, facing, gone + deep_mm, hit, normal)) return false;
    if (!(vec_dot(normal, facing) > -backwards)) return false;
    vec_scale(c->outward + 3 * (size_t)i, -1, rest_facing);
    return !shape->leave(shape->context, rest, rest_facing, vec_distance(hit, at) + deep_mm, rest_hit, rest_normal) ||
           vec_distance(rest, rest_hit) <= deep_mm; /* its own surface */
}

/* A plane across the way back, which stays. */
static void raise_guard(contact_link *guard, const double facing[3], const double hit[3], double behind)
{
    guard->near = guard->flat = true;
    guard->at_face = !(behind > 0);
    vec_copy(facing, guard->m);
    guard->base = behind - vec_dot(facing, hit);
}

/* A guarded node that the bone's distance pushes out at the far side, and that lies between the two for ever: the guard
 * alone has it, from the face of the bone on. */
static bool is_for_guard(contact_link *guard, const double grad[3])
{
    if (vec_dot(grad, guard->m) > backwards * vec_norm(grad)) return false;
    if (!guard->at_face) guard->base -= behind_mm;
    guard->at_face = true;
    return true;
}

void contact_find_side(const contact *c, int32_t i, contact_link *link, const double *x)
{
    enum { MOST_TURNS = 6 };
    contact_link *guard = c->setup.held ? link + 1 : NULL;
    const bone_shape *shape = c->setup.shape[link->collider];
    double at[3], facing[3], grad[3], hit[3];
    look(c, i, link->collider, x, at, facing);
    double d = shape->distance(shape->context, at, grad, NULL);
    bool wrong = d < 0 && vec_dot(grad, facing) <= backwards * vec_norm(grad);
    bool before = link->flat;
    link->flat = wrong && find_way_back(c, i, link->collider, at, facing, hit, link->m);
    if (link->flat) link->base = -vec_dot(link->m, hit);
    link->turns += link->flat != before;
    link->lost = wrong && !link->flat && d < -given_up_mm;
    if (link->flat &&
        link->turns > MOST_TURNS) { /* it would turn for ever: the plane stays, and the bone's right side */
        if (guard && !guard->near) raise_guard(guard, facing, hit, 0);
        link->flat = false;
        link->lost = !guard;
    }
    link->near = link->flat || (d < HUGE_VAL && !link->lost && !(wrong && link->turns > MOST_TURNS));
    if (guard && guard->near && !link->flat && link->near) link->near = !is_for_guard(guard, grad);
}

/* Outside, but its straight way there leads through the bone, and so does the way that it should be pushed.
 * hit: where that leaves the bone, towards facing. */
static bool has_passed(const contact *c, int32_t i, const contact_link *link, const double *x, double facing[3],
                       double hit[3])
{
    if (is_lip(link) || link->guard || link->flat) return false;
    const bone_shape *shape = c->setup.shape[link->collider];
    double at[3], back[3], normal[3], grad[3];
    look(c, i, link->collider, x, at, facing);
    vec_sub(c->rest_xyz + 3 * (size_t)c->node[i], at, back);
    double gone = vec_normalize(back);
    return gone > least_mm && shape->distance(shape->context, at, grad, NULL) >= 0 &&
           shape->leave(shape->context, at, back, gone, hit, normal) &&
           find_way_back(c, i, link->collider, at, facing, hit, normal) &&
           vec_dot(hit, normal) - vec_dot(at, normal) > edge_mm;
}

int32_t contact_passed(const contact *c, const double *x)
{
    int32_t count = 0;
    double facing[3], hit[3];
    for (int32_t i = 0; i < c->node_count; i++) {
        bool passed = false;
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
            passed = passed || has_passed(c, i, &c->link[l], x, facing, hit);
        count += passed;
    }
    return count;
}

/* Sliding nodes are where their own bone has them. */
static bool is_free(const contact *c, int32_t i) { return c->level_segment[i] < 0; }

int32_t contact_guard(contact *c, const double *x)
{
    int32_t count = 0;
    double facing[3], hit[3];
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            contact_link *guard = &c->link[l];
            if (!guard->guard || guard->near || !is_free(c, i) || !has_passed(c, i, guard - 1, x, facing, hit))
                continue;
            raise_guard(guard, facing, hit, behind_mm);
            count++;
        }
    return count;
}
