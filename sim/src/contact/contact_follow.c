/* Sliding nodes on the level of their bone's distance. */
#include "sim/src/contact/contact_state.h"
#include "geometry/vec.h"
#include <math.h>
#include <stddef.h>

static const double flat = 0.3; /* gradients shorter than this have no direction: between two surfaces */

/* How far the node at x is off its level along n (unit, out of its bone); false: the bone cannot tell. */
static bool find_off(const contact *c, const attach_map *attach, int32_t i, const double *x, double *off, double n[3])
{
    const int s = c->level_segment[i];
    if (s < 0) return false;
    const bone_shape *shape = c->setup.shape[s];
    double at[3], level = c->level_mm[i];
    if (attach->shift_mm) level = fmax(level + attach->shift_mm[c->node[i]], fmin(0, level)); /* not into the bone */
    rigid_apply(&c->back[s], x + 3 * (size_t)c->node[i], at);
    *off = shape->distance(shape->context, at, n, NULL) - level;
    double size = vec_norm(n);
    if (!isfinite(*off) || size < flat) return false;
    *off /= size;
    rigid_rotate(&c->motion[s], n, n);
    vec_scale(n, 1 / size, n);
    return true;
}

/* Turns a frame so that its first direction is n, by as little as that takes: unknowns keep their meaning. */
static void turn_frame(double basis[9], const double n[3])
{
    vec_copy(n, basis);
    vec_axpy(basis + 3, -vec_dot(basis + 3, n), n, basis + 3);
    vec_normalize(basis + 3);
    vec_cross(n, basis + 3, basis + 6);
}

void contact_retract(const contact *c, const attach_map *attach, double *x)
{
    for (int32_t i = 0; i < c->node_count; i++) {
        double off, n[3], *p = x + 3 * (size_t)c->node[i];
        if (find_off(c, attach, i, x, &off, n)) vec_axpy(p, -off, n, p);
    }
}

double contact_follow(const contact *c, const attach_map *attach, boundary *b, const double *x)
{
    double farthest = -1;
    for (int32_t i = 0; i < c->node_count; i++) {
        size_t v = (size_t)c->node[i];
        double off, n[3];
        if (!find_off(c, attach, i, x, &off, n)) continue;
        turn_frame(b->basis + 9 * v, n);
        vec_axpy(x + 3 * v, -off, n, b->origin + 3 * v);
        farthest = fmax(farthest, fabs(off));
    }
    return farthest;
}
