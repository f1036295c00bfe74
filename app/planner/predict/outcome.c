#include "app/planner/predict/outcome.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/transform_file.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

outcome outcome_of(const case_file *c, const prepared *p, const plan_file *plan, const plan_moves *moves,
                   contact_kind contact, const prediction *made)
{
    bool solved = made->solve.outcome == SOLVED;
    return (outcome){.patient = c,
                     .plan = plan,
                     .moves = moves,
                     .prepared = p,
                     .tissue = &made->flesh,
                     .solve = &made->solve,
                     .scene = &made->scene,
                     .u = made->u,
                     .skin = solved ? &made->skin : NULL,
                     .points = solved ? &made->points : NULL,
                     .depth = solved ? &made->depth : NULL,
                     .contact = contact,
                     .limits = &made->limits,
                     .stages = {.ready = made->ready_span, .solve = made->solve_span, .carry = made->shown_span}};
}

double outcome_relative_residual(const equilibrium *q)
{
    return q->iterations && q->reference_mn > 0 ? q->residual_mn / q->reference_mn : 0;
}

const char *outcome_trust(contact_kind contact)
{
#define TRUST(lips)                                                                                                    \
    "The equilibrium is solved to the residual given; the mesh error is not estimated yet, and published predictions " \
    "of this kind are 0.6 to 1.5 mm off on average, most at the lips, which here can " lips                            \
    ". Not for planning on patients."
    return contact == CONTACT_LIPS ? TRUST("part and meet") : TRUST("slide but neither part nor meet");
#undef TRUST
}

static bool write_surface(const surface *s, const output_dir *dir, const char *name, const char *extension, err *e)
{
    char file[64];
    snprintf(file, sizeof file, "%s%s", name, extension);
    char *path = output_dir_file(dir, file);
    bool ok = mesh_write_surface(s, path, e);
    free(path);
    return ok;
}

static bool write_segments(const outcome *o, const output_dir *dir, err *e)
{
    bool ok = true;
    for (int s = 0; ok && s < SEGMENT_COUNT; s++) {
        if (!o->prepared->segments.part[s].triangle_count) continue;
        char name[48], file[64];
        const rigid *move = &o->moves->move[s];
        surface moved = surface_copy(&o->prepared->segments.part[s]);
        surface_transform(&moved, move);
        snprintf(name, sizeof name, "segment_%s", segment_name((segment_id)s));
        ok = write_surface(&moved, dir, name, ".ply", e) && write_surface(&moved, dir, name, ".stl", e);
        surface_free(&moved);
        if (!ok || rigid_is_identity(move)) continue;
        snprintf(file, sizeof file, "%s.tfm", segment_name((segment_id)s));
        char *path = output_dir_file(dir, file);
        ok = transform_write(move, path, e);
        free(path);
    }
    return ok;
}

static bool write_tissue(const outcome *o, const output_dir *dir, err *e)
{
    const plan_tissue *t = o->tissue;
    double *kind = NEW_ARRAY(double, t->mesh.vertex_count), *segment = NEW_ARRAY(double, t->mesh.vertex_count);
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        kind[v] = t->attach.kind[v];
        segment[v] = t->attach.segment[v];
    }
    point_array arrays[] = {{"displacement", 3, o->u}, {"attachment", 1, kind}, {"segment", 1, segment}};
    char *path = output_dir_file(dir, "tissue.vtu");
    bool ok = mesh_write_tets(&t->mesh, arrays, 3, path, e);
    free(path);
    free(kind);
    free(segment);
    return ok;
}

bool outcome_write_meshes(const outcome *o, const output_dir *dir, err *e)
{
    if (!write_surface(&o->prepared->skin, dir, "skin_before", ".ply", e) ||
        !write_surface(o->skin, dir, "skin_after", ".ply", e) ||
        !write_surface(o->skin, dir, "skin_after", ".stl", e) || !write_segments(o, dir, e) || !write_tissue(o, dir, e))
        return false;
    char *path = output_dir_file(dir, "landmarks_planned.mrk.json");
    bool ok = landmarks_write(&o->points->after, path, e);
    free(path);
    return ok;
}

const char *outcome_stuck(const outcome *o, double at[3])
{
    const landmarks *l = &o->prepared->points;
    const char *name = "";
    double away = HUGE_VAL;
    if (o->solve->stuck_node < 0) return NULL;
    vec_copy(o->prepared->tissue.mesh.xyz + 3 * (size_t)o->solve->stuck_node, at);
    for (int32_t i = 0; i < l->count; i++) {
        double d = vec_distance(at, l->point[i].xyz);
        if (!(d < away)) continue;
        away = d;
        name = l->point[i].label;
    }
    return name;
}

double outcome_worst_tet(const outcome *o, double middle[3])
{
    const tetmesh *m = &o->prepared->tissue.mesh;
    const int32_t *node = m->tet + 4 * (size_t)o->solve->extremes.min_j_tet;
    double away = HUGE_VAL;
    for (int c = 0; c < 3; c++) {
        middle[c] = 0;
        for (int k = 0; k < 4; k++) middle[c] += 0.25 * m->xyz[3 * (size_t)node[k] + c];
    }
    for (int32_t v = 0; v < o->prepared->skin.vertex_count; v++)
        away = fmin(away, vec_distance(middle, o->prepared->skin.xyz + 3 * (size_t)v));
    return away;
}
