/* Nodes that a step took into a bone give way at once. */
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <math.h>
#include <stddef.h>

void contact_mark(contact *c)
{
    for (int32_t l = 0; l < c->link_count; l++) c->link[l].delta_here = c->link[l].delta;
}

/* How far the node has to go out. A Newton step foresaw the force f + f' (delta - delta_here); the node is
 * held by the stiffness k of what is around it: k a = 3 w (delta - a)^2 - foreseen. */
static double way_out(const contact_link *link, double k)
{
    double w = vec_norm(link->force) / (3 * link->delta * link->delta), here = link->delta_here;
    double foreseen = 3 * w * here * here + 6 * w * link->delta_factored * (link->delta - here);
    double over = 3 * w * link->delta * link->delta - foreseen, b = 6 * w * link->delta + k;
    if (!(over > 0)) return 0;
    return fmin(link->delta, 2 * over / (b + sqrt(fmax(0, b * b - 12 * w * over))));
}

static bool is_unforeseen(const contact *c, const contact_link *link)
{
    double more = fabs(link->delta - link->delta_here);
    return !is_lip(link) && link->delta > 0 && more > c->setup.params.depth_mm / 4 &&
           !contact_is_deep(c, link->delta_here);
}

double contact_yield(const contact *c, const boundary *b, double *z)
{
    double farthest = 0;
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            const contact_link *link = &c->link[l];
            if (!is_unforeseen(c, link)) continue;
            double way = way_out(link, c->around[i]), out[3];
            vec_scale(link->force, -way / vec_norm(link->force), out);
            size_t v = (size_t)c->node[i];
            for (int k = 0; k < 3; k++)
                if (b->unknown[3 * v + k] >= 0) z[b->unknown[3 * v + k]] += vec_dot(b->basis + 9 * v + 3 * k, out);
            farthest = fmax(farthest, way);
        }
    return farthest;
}
