/* touching: bodies that may touch bone or each other, ready to be solved. */
#pragma once
#include "app/stress/shapes.h"
#include "tests/physics/setting.h"
#include <stdio.h>
#include <string.h>

/* Points into itself: not to be copied. */
typedef struct touching {
    setting body;
    known_bone bone; /* of the distal segment */
    bone_shape shape;
    int32_t *upper, *lower;
    contact_setup setup;
} touching;

static inline void touching_free(touching *s)
{
    tear_down(&s->body);
    free(s->upper);
    free(s->lower);
}

static inline void wire_touching(touching *s, double poisson)
{
    s->body.table = tissue_material(MATERIAL_SNH_LOG, 15, poisson);
    wire(&s->body);
    s->setup.params = contact_params_default();
    s->body.problem.contact = &s->setup;
}

/* A block of 20 x 16 x 12 mm tied to the maxilla at its top, lying on the plane z = 0 of the distal segment. */
static inline void block_on_plane(touching *s, double poisson)
{
    block b = {5, 4, 4, {20, 16, 12}, 6, 0.15};
    *s = (touching){.body = {.mesh = block_mesh(&b)}, .bone = {KNOWN_PLANE, {0, 0, 0}, 0, 0}};
    tetmesh *m = &s->body.mesh;
    attach_map *a = &s->body.attach;
    *a = attach_map_new(m->vertex_count, 0);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        const double *x = m->xyz + 3 * (size_t)v;
        if (x[2] == 12) tie(a, v, SEGMENT_MAXILLA);
        if (x[2] != 0) continue;
        a->kind[v] = NODE_SLIDING;
        a->segment[v] = SEGMENT_DISTAL;
        a->normal[3 * (size_t)v + 2] = 1;
    }
    wire_touching(s, poisson);
    s->shape = known_shape(&s->bone);
    s->setup.shape[SEGMENT_DISTAL] = &s->shape;
}

/* A block held at its top over a plate as thin as an incisor's edge. Without contact it would stay where it is, with
 * its lowest nodes below the plate once that has risen. */
static inline void block_over_plate(touching *s, double thick)
{
    block b = {5, 4, 4, {20, 16, 12}, 6, 0.15};
    *s = (touching){.body = {.mesh = block_mesh(&b)}, .bone = {KNOWN_PLATE, {0, 0, -thick / 2 - 0.2}, thick / 2, 0.1}};
    tetmesh *m = &s->body.mesh;
    s->body.attach = attach_map_new(m->vertex_count, 0);
    s->upper = NEW_ARRAY(int32_t, m->vertex_count);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        if (m->xyz[3 * v + 2] == 12) tie(&s->body.attach, v, SEGMENT_MAXILLA);
        if (m->xyz[3 * v + 2] == 0) s->upper[s->setup.extra_count++] = v;
    }
    wire_touching(s, 0.45);
    s->shape = known_shape(&s->bone);
    s->setup.held = true;
    s->setup.shape[SEGMENT_DISTAL] = &s->shape;
    s->setup.extra = s->upper;
}

/* Faces of the mesh's boundary all of whose nodes have `mark`. */
static inline int32_t *marked_faces(const tetmesh *m, const uint8_t *marks, uint8_t mark, int32_t *count)
{
    int32_t *face = NULL, all = tetmesh_boundary(m, &face, NULL);
    *count = 0;
    for (int32_t f = 0; f < all; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        if (marks[v[0]] == mark && marks[v[1]] == mark && marks[v[2]] == mark)
            memmove(face + 3 * (size_t)(*count)++, v, 3 * sizeof *v);
    }
    return face;
}

/* Two lips, the upper tied to the maxilla, the lower to the distal segment. */
static inline void two_lips(touching *s)
{
    block b = {5, 4, 6, {20, 16, 24}, 5, 0.2};
    *s = (touching){0};
    s->body.mesh = lips_mesh(&b, 3, false, &s->body.attach);
    const attach_map *a = &s->body.attach;
    uint8_t *mark = NEW_ARRAY(uint8_t, s->body.mesh.vertex_count);
    for (int32_t i = 0; i < 2 * a->pair_count; i++) mark[a->pair[i]] = i % 2 ? 2 : 1;
    wire_touching(s, 0.47);
    s->setup.upper_lip = s->upper = marked_faces(&s->body.mesh, mark, 1, &s->setup.upper_count);
    s->setup.lower_lip = s->lower = marked_faces(&s->body.mesh, mark, 2, &s->setup.lower_count);
    assert_int_equal(s->setup.upper_count, 40);
    assert_int_equal(s->setup.lower_count, 40);
    free(mark);
}

/* The one or the other: what must hold for both. */
static inline void block_or_lips(touching *s, bool lips)
{
    if (lips)
        two_lips(s);
    else
        block_on_plane(s, 0.45);
}

static inline equilibrium solve_touching(const touching *s, const char *name)
{
    solve_params params = solve_params_default();
    equilibrium q = solve(&s->body, &params);
    const contact_report *c = &q.contact;
    printf(
        "%s: %s, %d of %d nodes touch, depth %.4f mm, %.1f + %.1f mm2, %.2f kPa, %d + %d iterations, %d refreshes (last "
        "%.1e mm), %d stiffenings, %d uncoupled, %.3g of %.3g uJ\n",
        name, solve_outcome_text(q.outcome), c->active_nodes, c->nodes, c->depth_mm, c->bone_area_mm2, c->lip_area_mm2,
        c->pressure_kpa, c->free_iterations, c->contact_iterations, c->refreshes, c->refresh_change_mm, c->stiffenings,
        c->uncoupled, c->energy_uj, q.energy_uj);
    assert_int_equal(q.outcome, SOLVED);
    return q;
}
