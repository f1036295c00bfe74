#include "geometry/attach_map.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/contact/contact_state.h"
#include <stdlib.h>
#include <string.h>

contact_params contact_params_default(void)
{
    return (contact_params){.support = 1.75,
                            .activation_mm = 0.1,
                            .depth_mm = 0.05,
                            .pressure_kpa = HUGE_VAL,
                            .depth_limit_mm = 0.1,
                            .max_stiffenings = 8,
                            .exact_limit_mm = 0.1,
                            .max_corrections = 4,
                            .facing_cos = -0.25,
                            .slide_mm = 5,
                            .free_rel_tol = 1e-2,
                            .free_iterations = 20,
                            .refresh_iterations = 25};
}

static bool check_params(const contact_params *p, err *e)
{
    if (!(p->support >= 1 && p->support <= 4))
        return err_set(e, ERR_INPUT, "contact support must lie between 1 and 4 edges, got %g", p->support);
    if (!(p->activation_mm >= 0))
        return err_set(e, ERR_INPUT, "contact activation_mm must be >= 0, got %g", p->activation_mm);
    if (!(p->depth_mm > 0)) return err_set(e, ERR_INPUT, "contact depth_mm must be > 0, got %g", p->depth_mm);
    if (!(p->pressure_kpa > 0))
        return err_set(e, ERR_INPUT, "contact pressure_kpa must be > 0, got %g", p->pressure_kpa);
    if (!(p->depth_limit_mm > 0))
        return err_set(e, ERR_INPUT, "contact depth_limit_mm must be > 0, got %g", p->depth_limit_mm);
    if (!(p->exact_limit_mm > 0))
        return err_set(e, ERR_INPUT, "contact exact_limit_mm must be > 0, got %g", p->exact_limit_mm);
    if (!(p->facing_cos >= -1 && p->facing_cos < 1))
        return err_set(e, ERR_INPUT, "contact facing_cos must lie in [-1, 1), got %g", p->facing_cos);
    if (!(p->slide_mm >= 0)) return err_set(e, ERR_INPUT, "contact slide_mm must be >= 0, got %g", p->slide_mm);
    if (!(p->free_rel_tol > 0 && p->free_rel_tol < 1))
        return err_set(e, ERR_INPUT, "contact free_rel_tol must lie between 0 and 1, got %g", p->free_rel_tol);
    if (p->free_iterations < 0 || p->refresh_iterations < 0 || p->max_stiffenings < 0 || p->max_corrections < 0)
        return err_set(e, ERR_INPUT, "contact iteration limits must be >= 0");
    return true;
}

attach_map contact_loosened(const attach_map *attach, const contact_setup *s)
{
    uint8_t *faced = NEW_ARRAY(uint8_t, attach->node_count);
    for (int32_t i = 0; i < 3 * s->upper_count; i++) faced[s->upper_lip[i]] = 1;
    for (int32_t i = 0; i < 3 * s->lower_count; i++) faced[s->lower_lip[i]] = 1;
    attach_map a = attach_map_new(attach->node_count, attach->pair_count);
    for (int32_t v = 0; v < a.node_count; v++) {
        bool tied = attach->kind[v] == NODE_TIED;
        a.kind[v] = tied ? NODE_TIED : NODE_FREE;
        a.segment[v] = tied ? attach->segment[v] : -1;
    }
    a.pair_count = 0;
    for (int32_t i = 0; i < attach->pair_count; i++) {
        if (faced[attach->pair[2 * i]] && faced[attach->pair[2 * i + 1]]) continue;
        memcpy(a.pair + 2 * (size_t)a.pair_count, attach->pair + 2 * (size_t)i, 2 * sizeof *a.pair);
        vec_copy(attach->pair_normal + 3 * (size_t)i, a.pair_normal + 3 * (size_t)a.pair_count++);
    }
    free(faced);
    return a;
}

static bool check_lists(const tetmesh *m, const attach_map *a, const contact_setup *s, err *e)
{
    const int32_t *face[2] = {s->upper_lip, s->lower_lip}, count[2] = {s->upper_count, s->lower_count};
    uint8_t *lip = NEW_ARRAY(uint8_t, m->vertex_count);
    bool ok = true;
    for (int side = 0; side < 2; side++)
        for (int32_t i = 0; ok && i < 3 * count[side]; i++) {
            int32_t v = face[side][i];
            if (v < 0 || v >= m->vertex_count)
                ok = err_set(e, ERR_INPUT, "lip face %d names node %d, out of range", i / 3, v);
            else if (lip[v] & (2 >> side))
                ok = err_set(e, ERR_INPUT, "node %d is in faces of both lips", v);
            else
                lip[v] |= (uint8_t)(1 << side);
        }
    for (int32_t i = 0; ok && i < s->extra_count; i++) {
        int32_t v = s->extra[i];
        if (v < 0 || v >= m->vertex_count || a->kind[v] == NODE_TIED)
            ok = err_set(e, ERR_INPUT, "node %d cannot meet bone: it is out of range or tied", v);
    }
    for (int32_t v = 0; ok && v < m->vertex_count; v++) {
        if (a->kind[v] == NODE_SLIDING && !s->held && !s->shape[a->segment[v]])
            ok = err_set(e, ERR_INPUT, "node %d slides on the %s, which has no shape to touch", v,
                         segment_name((segment_id)a->segment[v]));
    }
    free(lip);
    return ok;
}

/* Which nodes touch, and their areas and directions. Boundary faces that only such nodes span count; a node
 * without any takes its share of the mixed ones. */
static bool find_nodes(contact *c, const tetmesh *m, const attach_map *a, err *e)
{
    uint8_t *in = NEW_ARRAY(uint8_t, m->vertex_count);
    int32_t *number = NEW_ARRAY(int32_t, m->vertex_count), *face = NULL;
    const contact_setup *s = &c->setup;
    for (int32_t v = 0; v < m->vertex_count; v++) in[v] = a->kind[v] == NODE_SLIDING;
    for (int32_t i = 0; i < 3 * s->upper_count; i++) in[s->upper_lip[i]] |= a->kind[s->upper_lip[i]] != NODE_TIED;
    for (int32_t i = 0; i < 3 * s->lower_count; i++) in[s->lower_lip[i]] |= a->kind[s->lower_lip[i]] != NODE_TIED;
    for (int32_t i = 0; i < s->extra_count; i++) in[s->extra[i]] = 1;
    for (int32_t v = 0; v < m->vertex_count; v++) number[v] = in[v] ? c->node_count++ : -1;
    c->node = NEW_ARRAY(int32_t, c->node_count);
    c->area = NEW_ARRAY(double, c->node_count);
    c->outward = NEW_ARRAY(double, 3 * (size_t)c->node_count);
    c->around = NEW_ARRAY(double, c->node_count);
    c->energy = NEW_ARRAY(double, c->node_count);
    for (int32_t v = 0; v < m->vertex_count; v++)
        if (in[v]) c->node[number[v]] = v;
    int32_t faces = tetmesh_boundary(m, &face, NULL);
    double *mixed = NEW_ARRAY(double, 4 * (size_t)c->node_count);
    for (int32_t f = 0; f < faces; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        const double *x = m->xyz + 3 * (size_t)v[0];
        double u[3], w[3], n[3];
        vec_sub(m->xyz + 3 * (size_t)v[1], x, u);
        vec_sub(m->xyz + 3 * (size_t)v[2], x, w);
        vec_cross(u, w, n);
        bool all = in[v[0]] && in[v[1]] && in[v[2]];
        for (int k = 0; k < 3; k++) {
            int32_t i = number[v[k]];
            if (i < 0) continue;
            double *normal = all ? c->outward + 3 * (size_t)i : mixed + 4 * (size_t)i + 1;
            double *area = all ? c->area + i : mixed + 4 * (size_t)i;
            vec_add(normal, n, normal);
            *area += vec_norm(n) / 6;
        }
    }
    bool ok = true;
    for (int32_t i = 0; ok && i < c->node_count; i++) {
        if (!(c->area[i] > 0)) {
            c->area[i] = mixed[4 * (size_t)i];
            vec_copy(mixed + 4 * (size_t)i + 1, c->outward + 3 * (size_t)i);
        }
        if (!(vec_normalize(c->outward + 3 * (size_t)i) > 0))
            ok = err_set(e, ERR_INPUT, "node %d should touch but is not on the tissue's surface", c->node[i]);
    }
    free(mixed);
    free(face);
    free(number);
    free(in);
    return ok;
}

static void make_links(contact *c, const attach_map *a)
{
    c->link_start = NEW_ARRAY(int32_t, (size_t)c->node_count + 1);
    c->link = NEW_ARRAY(contact_link, 2 * COLLIDER_COUNT * (size_t)c->node_count);
    for (int32_t i = 0; i < c->node_count; i++) {
        c->link_start[i] = c->link_count;
        int other = -1; /* lip */
        if (c->own_sample[i] >= 0) {
            int32_t at = c->own_sample[i];
            bool upper = at < c->cloud[0].count && c->lip_node[0][at] == c->node[i];
            other = upper ? COLLIDER_LOWER : COLLIDER_UPPER;
        }
        for (int k = 0; k < COLLIDER_COUNT; k++) {
            if (k < SEGMENT_COUNT ? !c->setup.shape[k] : k != other) continue;
            if (c->setup.held && a->kind[c->node[i]] == NODE_SLIDING && a->segment[c->node[i]] == k) continue;
            contact_link link = {.collider = k, .stiffening = 1, .cover = 1, .faced = true};
            c->link[c->link_count++] = link;
            link.guard = true;
            if (c->setup.held && !is_lip(&link)) c->link[c->link_count++] = link;
        }
    }
    c->link_start[c->node_count] = c->link_count;
}

/* Its gap at rest, with what else is known from then on. */
static double look_at_lip(contact *c, int32_t i, contact_link *link, const double *x)
{
    static const double beside = 0.6; /* of h */
    lip_view v = contact_view_lip(c, i, link, x);
    if (v.nearest < 0) return HUGE_VAL;
    link->left_out = v.deep;
    link->faced = v.aside_mm / c->cloud[link->collider - COLLIDER_UPPER].h[v.nearest] <= beside;
    c->report.left_out += v.deep;
    /* beside the rim the plane goes on: a node behind it there is not to be pushed to its front */
    return isfinite(link->gap) && !v.deep ? link->gap : v.plane_mm < 0 ? v.plane_mm : HUGE_VAL;
}

/* Gaps at rest, from which thresholds follow. */
static void measure_rest(contact *c, const tetmesh *m)
{
    rigid still[SEGMENT_COUNT], guide = rigid_identity();
    for (int s = 0; s < SEGMENT_COUNT; s++) still[s] = rigid_identity();
    contact_move(c, still, &guide, m->xyz);
    c->motion_reach_mm = HUGE_VAL;
    contact_refresh(c, m->xyz);
    contact_energy(c, m->xyz, NULL);
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            contact_link *link = &c->link[l];
            double rest = link->gap;
            if (is_lip(link)) rest = look_at_lip(c, i, link, m->xyz);
            link->threshold_mm = link->guard ? 0 : fmin(c->setup.params.activation_mm, rest);
            link->depth_from_mm = fmin(0, rest);
        }
}

/* Levels on which sliding nodes lie at rest, before a shift that the attachment asks for. */
static void measure_levels(contact *c, const tetmesh *m, const attach_map *a)
{
    for (int32_t i = 0; i < c->node_count; i++) {
        int32_t v = c->node[i];
        const bone_shape *shape = a->kind[v] == NODE_SLIDING ? c->setup.shape[a->segment[v]] : NULL;
        double grad[3], level = HUGE_VAL;
        if (c->setup.held && shape) level = shape->distance(shape->context, m->xyz + 3 * (size_t)v, grad, NULL);
        c->level_segment[i] = level < HUGE_VAL ? (int8_t)a->segment[v] : -1;
        c->level_mm[i] = level;
    }
}

bool contact_make(const tetmesh *m, const attach_map *attach, const contact_setup *setup, double young_kpa,
                  contact **out, err *e)
{
    if (!check_params(&setup->params, e) || !check_lists(m, attach, setup, e)) return false;
    contact *c = NEW_ARRAY(contact, 1);
    const contact_params *p = &setup->params;
    c->setup = *setup;
    c->mesh_node_count = m->vertex_count;
    c->k = (isfinite(p->pressure_kpa) ? p->pressure_kpa : young_kpa) / (3 * p->depth_mm * p->depth_mm);
    bool ok = find_nodes(c, m, attach, e);
    c->own_sample = NEW_ARRAY(int32_t, c->node_count);
    c->level_mm = NEW_ARRAY(double, c->node_count);
    c->level_segment = NEW_ARRAY(int8_t, c->node_count);
    for (int32_t i = 0; i < c->node_count; i++) c->own_sample[i] = -1;
    ok = ok && contact_make_lips(c, m, e);
    if (ok && c->node_count == 0)
        ok = err_set(e, ERR_INPUT, "contact is on, but no node slides, is paired or is named to touch");
    if (ok) {
        make_links(c, attach);
        measure_rest(c, m);
        measure_levels(c, m, attach);
        *out = c;
    } else
        contact_destroy(&c);
    return ok;
}

void contact_destroy(contact **c)
{
    if (!*c) return;
    for (int32_t l = 0; l < (*c)->link_count; l++) {
        free((*c)->link[l].sample);
        free((*c)->link[l].weight);
    }
    for (int side = 0; side < 2; side++) {
        imls_free(&(*c)->cloud[side]);
        free((*c)->lip_node[side]);
        free((*c)->lip_tri[side]);
    }
    free((*c)->node);
    free((*c)->area);
    free((*c)->outward);
    free((*c)->around);
    free((*c)->level_mm);
    free((*c)->level_segment);
    free((*c)->own_sample);
    free((*c)->link_start);
    free((*c)->link);
    free((*c)->energy);
    free((*c)->coupling);
    free(*c);
    *c = NULL;
}
