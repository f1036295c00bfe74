/* Lips as the other lip meets them: samples at their nodes, and what each node sees of them. */
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <stdlib.h>

static const double shallow = 0.4;  /* of h: what the plain support sees well */
static const double wide = 1 / 0.4; /* support of a deep node over its distance; meets 1 at shallow */

static void make_lip(contact *c, const tetmesh *m, int side, const int32_t *face, int32_t count)
{
    imls_cloud *cloud = &c->cloud[side];
    int32_t *number = NEW_ARRAY(int32_t, m->vertex_count);
    for (int32_t i = 0; i < 3 * count; i++)
        if (!number[face[i]]) number[face[i]] = ++cloud->count;
    size_t n = (size_t)cloud->count;
    cloud->x = NEW_ARRAY(double, 3 * n);
    cloud->n = NEW_ARRAY(double, 3 * n);
    cloud->area = NEW_ARRAY(double, n);
    cloud->h = NEW_ARRAY(double, n);
    c->lip_node[side] = NEW_ARRAY(int32_t, n);
    c->lip_tri_count[side] = count;
    c->lip_tri[side] = NEW_ARRAY(int32_t, 3 * (size_t)count);
    for (int32_t i = 0; i < 3 * count; i++) {
        int32_t at = c->lip_tri[side][i] = number[face[i]] - 1;
        c->lip_node[side][at] = face[i];
        vec_copy(m->xyz + 3 * (size_t)face[i], cloud->x + 3 * (size_t)at);
    }
    imls_shape(cloud, c->lip_tri[side], count, c->setup.params.support);
    for (int32_t i = 0; i < c->node_count; i++)
        if (number[c->node[i]]) c->own_sample[i] = number[c->node[i]] - 1;
    free(number);
}

static void make_couplings(contact *c, const tetmesh *m)
{
    const imls_cloud *u = &c->cloud[0], *l = &c->cloud[1];
    int32_t count = u->count + l->count, *node = NEW_ARRAY(int32_t, count), room = 0;
    double h = 0;
    for (int32_t i = 0; i < count; i++) {
        node[i] = i < u->count ? c->lip_node[0][i] : c->lip_node[1][i - u->count];
        h = fmax(h, i < u->count ? u->h[i] : l->h[i - u->count]);
    }
    for (int32_t i = 0; i < count; i++)
        for (int32_t j = 0; j < i; j++) {
            bool across = j < u->count && i >= u->count;
            double reach = across ? h + c->setup.params.slide_mm : 2 * h;
            if (vec_distance(m->xyz + 3 * (size_t)node[i], m->xyz + 3 * (size_t)node[j]) > reach) continue;
            if (c->coupling_count == room) {
                room = 2 * room + 256;
                c->coupling = GROW_ARRAY(int32_t, c->coupling, 2 * (size_t)room);
            }
            int32_t *pair = c->coupling + 2 * (size_t)c->coupling_count++;
            pair[0] = node[i] < node[j] ? node[i] : node[j];
            pair[1] = node[i] < node[j] ? node[j] : node[i];
        }
    free(node);
}

bool contact_make_lips(contact *c, const tetmesh *m, err *e)
{
    const contact_setup *s = &c->setup;
    double deepest = s->params.activation_mm + s->params.depth_limit_mm;
    if ((s->upper_count > 0) != (s->lower_count > 0))
        return err_set(e, ERR_INPUT, "the %s lip has contact faces, the other has none",
                       s->upper_count ? "upper" : "lower");
    if (!s->upper_count) return true;
    make_lip(c, m, 0, s->upper_lip, s->upper_count);
    make_lip(c, m, 1, s->lower_lip, s->lower_count);
    make_couplings(c, m);
    for (int side = 0; side < 2; side++)
        for (int32_t i = 0; i < c->cloud[side].count; i++) {
            const double *x = c->cloud[side].x + 3 * (size_t)i, h = c->cloud[side].h[i];
            if (!(h > 2.5 * deepest))
                return err_set(e, ERR_INPUT,
                               "a lip is too fine about %.1f %.1f %.1f mm: its support of %.2f mm would not "
                               "see a contact "
                               "%.2f mm deep",
                               x[0], x[1], x[2], h, deepest);
        }
    return true;
}

void contact_move_lips(contact *c, const double *x)
{
    for (int side = 0; side < 2; side++) {
        imls_cloud *cloud = &c->cloud[side];
        for (int32_t i = 0; i < cloud->count; i++)
            vec_copy(x + 3 * (size_t)c->lip_node[side][i], cloud->x + 3 * (size_t)i);
        if (cloud->count) imls_shape(cloud, c->lip_tri[side], c->lip_tri_count[side], 0);
    }
}

/* The direction that a sample must face. */
static void face(const contact *c, int32_t i, const contact_link *link, double facing[3])
{
    int own = link->collider == COLLIDER_UPPER ? 1 : 0;
    vec_scale(c->cloud[own].n + 3 * (size_t)c->own_sample[i], -1, facing);
}

lip_view contact_view_lip(const contact *c, int32_t i, const contact_link *link, const double *x)
{
    const imls_cloud *cloud = &c->cloud[link->collider - COLLIDER_UPPER];
    const double *at = x + 3 * (size_t)c->node[i];
    lip_view v = {.nearest = -1};
    double r[3], facing[3], best = HUGE_VAL;
    face(c, i, link, facing);
    for (int32_t s = 0; s < cloud->count; s++) {
        vec_sub(at, cloud->x + 3 * (size_t)s, r);
        double square = vec_dot(r, r);
        if (square >= best || vec_dot(cloud->n + 3 * (size_t)s, facing) < c->setup.params.facing_cos) continue;
        best = square;
        v.nearest = s;
    }
    if (v.nearest < 0) return v;
    double h = cloud->h[v.nearest];
    vec_sub(at, cloud->x + 3 * (size_t)v.nearest, r);
    v.plane_mm = vec_dot(cloud->n + 3 * (size_t)v.nearest, r);
    v.aside_mm = sqrt(fmax(0, best - v.plane_mm * v.plane_mm));
    v.deep = -v.plane_mm > shallow * h && v.aside_mm <= fmax(h, sqrt(best) / 2);
    return v;
}

void contact_refresh_lip(contact *c, int32_t i, contact_link *link, const double *x)
{
    const imls_cloud *cloud = &c->cloud[link->collider - COLLIDER_UPPER];
    const double *at = x + 3 * (size_t)c->node[i];
    lip_view seen = contact_view_lip(c, i, link, x);
    double facing[3], scale = 1;
    link->near = link->lost = false;
    link->count = 0;
    if (seen.nearest < 0) return;
    if (seen.deep && link->faced) {
        double depth = -seen.plane_mm, h = cloud->h[seen.nearest];
        link->lost = depth > c->motion_reach_mm + shallow * h;
        if (link->lost) return;
        scale = wide * depth / h;
    }
    face(c, i, link, facing);
    for (int32_t s = 0; s < cloud->count; s++) {
        double r[3], reach = scale * cloud->h[s];
        vec_sub(at, cloud->x + 3 * (size_t)s, r);
        if (vec_dot(r, r) >= reach * reach || vec_dot(cloud->n + 3 * (size_t)s, facing) < c->setup.params.facing_cos)
            continue;
        if (link->count == link->room) {
            link->room = 2 * link->room + 16;
            link->sample = GROW_ARRAY(int32_t, link->sample, link->room);
            link->weight = GROW_ARRAY(double, link->weight, link->room);
        }
        link->sample[link->count++] = s;
    }
    if (!link->count) return;
    imls_value v = imls_at(cloud, link->sample, link->count, scale, at, link->weight);
    link->cover = imls_cover(v.S);
    link->near = link->cover > 0;
    if (!link->near) return;
    vec_copy(v.grad, link->m);
    link->base = v.d - vec_dot(v.grad, at);
    for (int32_t k = 0; k < link->count; k++)
        link->base += link->weight[k] * vec_dot(v.grad, cloud->x + 3 * (size_t)link->sample[k]);
}
