#include "app/planner/predict/bone_depth.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>

static const double limit_mm = 0.1, deep_mm = 1;

typedef struct bones {
    nearest *const *part;
    const nearest *skin;
    const rest_gap *gap;
    rigid back[SEGMENT_COUNT];
} bones;

static double depth_in(const nearest *part, const double p[3])
{
    return part && nearest_inside(part, p) ? nearest_point(part, p, NULL, NULL) : 0;
}

/* A third of the faces around each node. */
static double *node_areas(const tetmesh *m)
{
    double *area = NEW_ARRAY(double, m->vertex_count);
    int32_t *face, faces = tetmesh_boundary(m, &face, NULL);
    for (int32_t f = 0; f < faces; f++) {
        double u[3], w[3], n[3];
        const int32_t *v = face + 3 * (size_t)f;
        vec_sub(m->xyz + 3 * (size_t)v[1], m->xyz + 3 * (size_t)v[0], u);
        vec_sub(m->xyz + 3 * (size_t)v[2], m->xyz + 3 * (size_t)v[0], w);
        vec_cross(u, w, n);
        for (int k = 0; k < 3; k++) area[v[k]] += vec_norm(n) / 6;
    }
    free(face);
    return area;
}

static void ask_node(const bones *b, int32_t v, const double rest[3], const double x[3], double area, bone_depth *r)
{
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        double before[3];
        if (!b->part[s]) continue;
        rigid_apply(&b->back[s], x, before);
        if (b->gap->part[s][v] > vec_distance(rest, before)) continue; /* it came no farther than up to the bone */
        double deeper = depth_in(b->part[s], before);
        if (deeper > limit_mm) deeper -= fmax(0, -b->gap->part[s][v]);
        if (deeper <= limit_mm) continue;
        r->nodes++;
        r->area_mm2 += area;
        if (deeper > deep_mm) r->area_deep_mm2 += area;
        if (deeper > r->depth_mm) {
            r->depth_mm = deeper;
            r->segment = s;
            r->from_skin_mm = nearest_point(b->skin, rest, NULL, NULL);
            vec_copy(x, r->at);
        }
        return;
    }
}

bone_depth bone_depth_measure(const prepared *p, const bone_shapes *shapes, const plan_moves *moves,
                              const attach_map *a, const double *xyz)
{
    bones b = {.part = shapes->trees.part, .skin = shapes->trees.skin, .gap = &shapes->gap};
    bone_depth out = {.limit_mm = limit_mm, .segment = -1};
    const tissue *t = &p->tissue;
    double *area = node_areas(&t->mesh);
    for (int s = 0; s < SEGMENT_COUNT; s++) b.back[s] = rigid_inverse(&moves->move[s]);
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        if (rest_gap_asks(t, v) && a->kind[v] != NODE_TIED)
            ask_node(&b, v, t->mesh.xyz + 3 * (size_t)v, xyz + 3 * (size_t)v, area[v], &out);
    }
    free(area);
    return out;
}
