/* From a row of the table to a solve. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static double random_unit(uint64_t *state) /* [-1, 1) */
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

static void make_materials(const stress_case *c, stress_scene *s)
{
    err e = {0};
    double young = c->young > 0 ? c->young : 15, contrast = c->contrast > 0 ? c->contrast : 1;
    double poisson = c->model == MATERIAL_ARAP ? 0 : c->poisson > 0 ? c->poisson : 0.45;
    s->material_count = 2;
    for (int k = 0; k < s->material_count; k++) {
        s->material[k].region = k;
        bool ok = material_make((material_model)c->model, k ? young * contrast : young, poisson,
                                &s->material[k].material, &e) &&
                  element_choose(&s->material[k].material, c->average ? ELEMENT_AVERAGED : ELEMENT_LINEAR, &e);
        assert(ok); /* the table is ours */
    }
}

static void middle_of(const stress_scene *s, segment_id segment, double out[3])
{
    int32_t count = 0;
    memset(out, 0, 3 * sizeof *out);
    for (int32_t v = 0; v < s->mesh.vertex_count; v++)
        if (s->attach.kind[v] == NODE_TIED && s->attach.segment[v] == (int32_t)segment) {
            vec_add(out, s->mesh.xyz + 3 * (size_t)v, out);
            count++;
        }
    if (count) vec_scale(out, 1.0 / count, out);
}

static void make_motion(const stress_case *c, double scale, stress_scene *s)
{
    for (int k = 0; k < SEGMENT_COUNT; k++) s->motion[k] = rigid_identity();
    double pivot[3], move[3], back[3], axis[3];
    middle_of(s, SEGMENT_MAXILLA, pivot);
    vec_scale(c->move, scale, move);
    vec_scale(move, -1, back);
    vec_copy(c->axis, axis);
    rigid turn = rigid_identity();
    if (vec_normalize(axis) > 0) turn = rigid_rotation(pivot, axis, c->turn_deg * M_PI / 180);
    rigid shift = rigid_translation(move);
    s->motion[SEGMENT_MAXILLA] = rigid_compose(&shift, &turn);
    if (c->oppose) s->motion[SEGMENT_DISTAL] = rigid_translation(back);
    for (int k = 0; c->together && k < SEGMENT_COUNT; k++) s->motion[k] = s->motion[SEGMENT_MAXILLA];
}

static void make_start(const stress_case *c, double scale, stress_scene *s)
{
    if (c->start == START_NONE) return;
    size_t n = (size_t)s->mesh.vertex_count;
    s->start_xyz = COPY_ARRAY(double, s->mesh.xyz, 3 * n);
    uint64_t seed = 1;
    for (size_t v = 0; v < n; v++) {
        double *x = s->start_xyz + 3 * v;
        switch ((stress_start)c->start) {
        case START_JITTER:
            for (int k = 0; k < 3; k++) x[k] += 4 * scale * random_unit(&seed);
            break;
        case START_MIRROR: x[0] = c->size[0] * scale - x[0]; break;
        case START_POINT:
            for (int k = 0; k < 3; k++) x[k] = c->size[k] * scale / 2;
            break;
        case START_FAR: x[1] += 1000 * scale; break;
        case START_SUNK: x[2] -= 6 * scale; break;
        case START_NAN:
            if (v == n / 2) x[1] = (double)NAN;
            break;
        case START_NONE: break;
        }
    }
}

void stress_scene_make(const stress_case *c, double scale, stress_scene *s)
{
    *s = (stress_scene){.params = solve_params_default()};
    if (!(scale > 0)) scale = c->scale > 0 ? c->scale : 1;
    c->body(c, s);
    for (size_t i = 0; i < 3 * (size_t)s->mesh.vertex_count; i++)
        s->mesh.xyz[i] = s->mesh.xyz[i] * scale + (i % 3 == 1 ? c->shift_mm : 0);
    make_materials(c, s);
    make_motion(c, scale, s);
    make_start(c, scale, s);
    s->params.max_step_mm *= scale;
    if (c->rel_tol > 0) s->params.rel_tol = c->rel_tol;
    if (c->load_steps > 0) s->params.load_steps = c->load_steps;
}

equilibrium_problem stress_problem(const stress_scene *s)
{
    equilibrium_problem p = {.mesh = &s->mesh,
                             .attach = &s->attach,
                             .materials = s->material,
                             .material_count = s->material_count,
                             .contact = s->touches ? &s->contact : NULL,
                             .start_xyz = s->start_xyz};
    memcpy(p.motion, s->motion, sizeof p.motion);
    return p;
}

void stress_scene_free(stress_scene *s)
{
    tetmesh_free(&s->mesh);
    attach_map_free(&s->attach);
    free(s->start_xyz);
    free(s->upper);
    free(s->lower);
    free(s->extra);
    *s = (stress_scene){0};
}
