/* setting: bodies, bones and materials ready to be solved. */
#pragma once
#include "tests/check.h"
#include "sim/equilibrium.h"
#include "tests/physics/lips.h"

static inline region_material tissue_material(material_model model, double young_kpa, double poisson)
{
    err e = {0};
    region_material table = {REGION_ANY, {0}};
    assert_ok(material_make(model, young_kpa, poisson, &table.material, &e));
    return table;
}

typedef struct setting {
    tetmesh mesh;
    attach_map attach;
    region_material table;
    equilibrium_problem problem;
} setting;

static inline void wire(setting *s)
{
    s->problem =
        (equilibrium_problem){.mesh = &s->mesh, .attach = &s->attach, .materials = &s->table, .material_count = 1};
    rest_motions(s->problem.motion);
}

static inline void tear_down(setting *s)
{
    tetmesh_free(&s->mesh);
    attach_map_free(&s->attach);
}

/* Every kind of node; the maxilla turns and advances. */
static inline void lips_setting(setting *s)
{
    block b = {6, 5, 6, {24, 20, 24}, 5, 0.2};
    s->mesh = lips_mesh(&b, 3, true, &s->attach);
    s->table = tissue_material(MATERIAL_SNH_LOG, 15, 0.47);
    wire(s);
    s->problem.motion[SEGMENT_MAXILLA] = rigid_rotation((double[]){12, 10, 24}, (double[]){0.2, 0.3, 1}, 0.3);
    vec_add(s->problem.motion[SEGMENT_MAXILLA].t, (double[]){0, 3, -2}, s->problem.motion[SEGMENT_MAXILLA].t);
}

static inline void slab_setting(setting *s, int scale)
{
    s->mesh = slab_mesh(6 * scale, 7 * scale, scale, &s->attach);
    s->table = tissue_material(MATERIAL_SNH_LOG, 15, 0.45);
    wire(s);
    s->problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 2, 6});
}

static inline equilibrium solve(const setting *s, const solve_params *params)
{
    err e = {0};
    equilibrium q;
    assert_ok(equilibrium_solve(&s->problem, params, &q, &e));
    return q;
}

static inline double apart(const equilibrium *a, const equilibrium *b)
{
    double worst = 0;
    for (int32_t i = 0; i < 3 * a->node_count; i++) worst = fmax(worst, fabs(a->xyz[i] - b->xyz[i]));
    return worst;
}

static inline void block_setting(setting *s, int cells, double compression)
{
    block b = {2 * cells, 2 * cells, cells, {40, 40, 20}, 6, 0};
    *s = (setting){.mesh = block_mesh(&b), .table = tissue_material(MATERIAL_SNH_LOG, 15, 0.45)};
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    for (int32_t v = 0; v < s->mesh.vertex_count; v++) {
        if (s->mesh.xyz[3 * (size_t)v + 2] == 0) tie(&s->attach, v, SEGMENT_DISTAL);
        if (s->mesh.xyz[3 * (size_t)v + 2] == 20) tie(&s->attach, v, SEGMENT_MAXILLA);
    }
    wire(s);
    s->problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -20 * compression});
}
