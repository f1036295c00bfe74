/* A part of the tissue: what moves, between what does not. */
#include "sim/src/scene/scene_part.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

/* Nodes to hold: not tied, and hardly moved; of two that face each other neither unless both. */
static void choose_held(const attach_map *a, const double *estimate, double limit_mm, scene_part *p)
{
    p->held = NEW_ARRAY(uint8_t, a->node_count);
    for (int32_t v = 0; v < a->node_count; v++) p->held[v] = a->kind[v] != NODE_TIED && estimate[v] < limit_mm;
    for (int32_t i = 0; i < a->pair_count; i++) {
        const int32_t *pair = a->pair + 2 * (size_t)i;
        if (!p->held[pair[0]] || !p->held[pair[1]]) p->held[pair[0]] = p->held[pair[1]] = 0;
    }
    for (int32_t v = 0; v < a->node_count; v++) p->held_count += p->held[v];
}

static void choose_tets(const tetmesh *m, const attach_map *a, scene_part *p)
{
    int32_t nodes = 0, tets = 0;
    p->tet = NEW_ARRAY(int32_t, m->tet_count);
    p->local = NEW_ARRAY(int32_t, m->vertex_count);
    for (int32_t t = 0; t < m->tet_count; t++) {
        const int32_t *v = m->tet + 4 * (size_t)t;
        bool any = false;
        for (int k = 0; k < 4; k++) any |= a->kind[v[k]] != NODE_TIED && !p->held[v[k]];
        if (!any) continue;
        p->tet[tets++] = t;
        for (int k = 0; k < 4; k++) p->local[v[k]] = 1;
    }
    p->node = NEW_ARRAY(int32_t, m->vertex_count);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        if (p->local[v]) p->node[nodes] = v;
        p->local[v] = p->local[v] ? nodes++ : -1;
    }
    p->mesh = tetmesh_new(nodes, tets);
    for (int32_t i = 0; i < nodes; i++) vec_copy(m->xyz + 3 * (size_t)p->node[i], p->mesh.xyz + 3 * (size_t)i);
    for (int32_t i = 0; i < tets; i++) {
        for (size_t k = 0; k < 4; k++) p->mesh.tet[4 * (size_t)i + k] = p->local[m->tet[4 * (size_t)p->tet[i] + k]];
        p->mesh.region[i] = m->region[p->tet[i]];
    }
}

static void choose_attachments(const attach_map *a, scene_part *p)
{
    p->attach = attach_map_new(p->mesh.vertex_count, a->pair_count);
    if (a->shift_mm) p->attach.shift_mm = NEW_ARRAY(double, p->mesh.vertex_count);
    for (int32_t i = 0; i < p->mesh.vertex_count; i++) {
        int32_t v = p->node[i];
        p->attach.kind[i] = p->held[v] ? NODE_TIED : a->kind[v];
        p->attach.segment[i] = p->held[v] ? SEGMENT_CRANIUM : a->segment[v];
        if (a->shift_mm && !p->held[v]) p->attach.shift_mm[i] = a->shift_mm[v];
        if (!p->held[v]) vec_copy(a->normal + 3 * (size_t)v, p->attach.normal + 3 * (size_t)i);
    }
    p->attach.pair_count = 0;
    for (int32_t i = 0; i < a->pair_count; i++) {
        int32_t up = p->local[a->pair[2 * (size_t)i]], low = p->local[a->pair[2 * (size_t)i + 1]];
        if (up < 0 || low < 0 || p->attach.kind[up] != NODE_FREE || p->attach.kind[low] != NODE_FREE) continue;
        p->attach.pair[2 * p->attach.pair_count] = up;
        p->attach.pair[2 * p->attach.pair_count + 1] = low;
        vec_copy(a->pair_normal + 3 * (size_t)i, p->attach.pair_normal + 3 * (size_t)p->attach.pair_count++);
    }
}

/* Faces whose three nodes are all in the part and not all held. */
static int32_t *keep_faces(const scene_part *p, const int32_t *face, int32_t count, int32_t *kept)
{
    int32_t *out = NEW_ARRAY(int32_t, 3 * (size_t)count);
    *kept = 0;
    for (int32_t f = 0; f < count; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        if (p->local[v[0]] < 0 || p->local[v[1]] < 0 || p->local[v[2]] < 0) continue;
        if (p->held[v[0]] && p->held[v[1]] && p->held[v[2]]) continue;
        for (int k = 0; k < 3; k++) out[3 * (size_t)*kept + (size_t)k] = p->local[v[k]];
        ++*kept;
    }
    return out;
}

/* What can still touch: contact between nodes that are held cannot change. */
static void choose_contact(const contact_setup *s, scene_part *p)
{
    p->contact = *s;
    p->upper = keep_faces(p, s->upper_lip, s->upper_count, &p->contact.upper_count);
    p->lower = keep_faces(p, s->lower_lip, s->lower_count, &p->contact.lower_count);
    if (!p->contact.upper_count || !p->contact.lower_count) p->contact.upper_count = p->contact.lower_count = 0;
    p->extra = NEW_ARRAY(int32_t, s->extra_count);
    p->contact.extra_count = 0;
    for (int32_t i = 0; i < s->extra_count; i++)
        if (p->local[s->extra[i]] >= 0 && !p->held[s->extra[i]])
            p->extra[p->contact.extra_count++] = p->local[s->extra[i]];
    p->contact.upper_lip = p->upper;
    p->contact.lower_lip = p->lower;
    p->contact.extra = p->extra;
}

void scene_part_free(scene_part *p)
{
    tetmesh_free(&p->mesh);
    attach_map_free(&p->attach);
    free(p->node);
    free(p->local);
    free(p->tet);
    free(p->held);
    free(p->upper);
    free(p->lower);
    free(p->extra);
    *p = (scene_part){0};
}

static bool can_touch(const scene_part *p)
{
    for (int32_t v = 0; v < p->attach.node_count; v++)
        if (p->attach.kind[v] == NODE_SLIDING) return true;
    return p->contact.upper_count > 0 || p->contact.extra_count > 0;
}

/* From numbers of the part to numbers of the whole; what is left out goes with the cranium. */
static void widen(const scene_part *p, const tetmesh *m, const attach_map *a, const rigid motion[SEGMENT_COUNT],
                  equilibrium *q)
{
    double *x = NEW_ARRAY(double, 3 * (size_t)m->vertex_count);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        int segment = a->kind[v] == NODE_TIED ? a->segment[v] : SEGMENT_CRANIUM;
        if (p->local[v] >= 0)
            vec_copy(q->xyz + 3 * (size_t)p->local[v], x + 3 * (size_t)v);
        else
            rigid_apply(&motion[segment], m->xyz + 3 * (size_t)v, x + 3 * (size_t)v);
    }
    free(q->xyz);
    q->xyz = x;
    q->node_count = m->vertex_count;
    if (q->stuck_node >= 0) q->stuck_node = p->node[q->stuck_node];
    if (q->extremes.min_j_tet >= 0) q->extremes.min_j_tet = p->tet[q->extremes.min_j_tet];
    if (q->extremes.max_stretch_tet >= 0) q->extremes.max_stretch_tet = p->tet[q->extremes.max_stretch_tet];
}

void scene_part_make(const equilibrium_problem *problem, const double *estimate, double limit_mm, scene_part *out)
{
    scene_part p = {0};
    choose_held(problem->attach, estimate, limit_mm, &p);
    choose_tets(problem->mesh, problem->attach, &p);
    choose_attachments(problem->attach, &p);
    if (problem->contact) choose_contact(problem->contact, &p);
    *out = p;
}

bool scene_part_solve(const equilibrium_problem *problem, const scene_part *p, const double *start,
                      const solve_params *params, equilibrium *out, err *e)
{
    equilibrium_problem own = *problem;
    double *from = NULL;
    own.mesh = &p->mesh;
    own.attach = &p->attach;
    own.contact = problem->contact && can_touch(p) ? &p->contact : NULL;
    if (start) {
        from = NEW_ARRAY(double, 3 * (size_t)p->mesh.vertex_count);
        for (int32_t i = 0; i < p->mesh.vertex_count; i++)
            vec_copy(start + 3 * (size_t)p->node[i], from + 3 * (size_t)i);
    }
    own.start_xyz = from;
    bool ok = equilibrium_solve(&own, params, out, e);
    if (ok) widen(p, problem->mesh, problem->attach, problem->motion, out);
    free(from);
    return ok;
}
