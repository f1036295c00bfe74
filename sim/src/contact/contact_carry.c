/* Contacts from one plan to the next. */
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <stddef.h>

void contact_resume(contact *c)
{
    int32_t left_out = c->report.left_out;
    for (int32_t l = 0; l < c->link_count; l++) c->link[l].turns = 0;
    c->report = (contact_report){.left_out = left_out};
}

static void take(contact_link *link, const contact_link *before)
{
    link->stiffening = before->stiffening;
    link->off_mm = before->off_mm;
    if (!link->guard || !before->near) return;
    link->near = true;
    link->flat = before->flat;
    link->at_face = before->at_face;
    link->base = before->base;
    vec_copy(before->m, link->m);
}

void contact_inherit(contact *c, const contact *before)
{
    for (int32_t i = 0, j = 0; i < c->node_count; i++) { /* nodes ascend in both */
        while (j < before->node_count && before->node[j] < c->node[i]) j++;
        if (j == before->node_count || before->node[j] != c->node[i]) continue;
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++)
            for (int32_t k = before->link_start[j]; k < before->link_start[j + 1]; k++)
                if (before->link[k].collider == c->link[l].collider && before->link[k].guard == c->link[l].guard)
                    take(&c->link[l], &before->link[k]);
    }
}

/* How the gradient of (tau - d)^3 changes along its normal; bend of the bone is left out. */
void contact_carry(const contact *c, const rigid on[SEGMENT_COUNT], const double *x, const double *carried,
                   double *force)
{
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            const contact_link *link = &c->link[l];
            size_t v = 3 * (size_t)c->node[i];
            double off[3], bone[3], size = vec_norm(link->force), normal[3];
            if (!(link->delta > 0) || is_lip(link)) continue;
            rigid_apply(&on[link->collider], x + v, bone);
            vec_sub(bone, x + v, bone);
            vec_sub(carried + v, bone, off);
            vec_scale(link->force, 1 / size, normal);
            vec_axpy(force + v, 2 * size / link->delta * vec_dot(normal, off), normal, force + v);
        }
}
