#include "app/planner/patient/prepared_sound.h"
#include <math.h>
#include <string.h>

bool all_finite(const double *x, int64_t count)
{
    for (int64_t i = 0; i < count; i++)
        if (!isfinite(x[i])) return false;
    return true;
}

bool all_within(const int32_t *n, int64_t count, int32_t low, int32_t end)
{
    for (int64_t i = 0; i < count; i++)
        if (n[i] < low || n[i] >= end) return false;
    return true;
}

bool surface_is_sound(const surface *s)
{
    return all_finite(s->xyz, 3 * (int64_t)s->vertex_count) &&
           all_within(s->tri, 3 * (int64_t)s->triangle_count, 0, s->vertex_count);
}

static bool frame_is_sound(const head_frame *f)
{
    const double *axis[3] = {f->left, f->posterior, f->up};
    if (!all_finite(f->origin, 3) || !isfinite(f->residual_mm)) return false;
    for (int i = 0; i < 3; i++)
        for (int k = i; k < 3; k++) {
            double dot = axis[i][0] * axis[k][0] + axis[i][1] * axis[k][1] + axis[i][2] * axis[k][2];
            if (!(fabs(dot - (i == k)) < 1e-6)) return false;
        }
    return true;
}

static bool points_are_sound(const landmarks *l)
{
    for (int32_t i = 0; i < l->count; i++) {
        const landmark *p = &l->point[i];
        if (!*p->label || !memchr(p->label, 0, sizeof p->label) || !all_finite(p->xyz, 3)) return false;
        for (int32_t k = 0; k < i; k++)
            if (!strcmp(l->point[k].label, p->label)) return false;
    }
    return l->count > 0;
}

/* A tied or sliding node hangs on a bone that is there. */
static bool attachment_is_sound(const attach_map *a, const segments *bones)
{
    for (int32_t i = 0; i < a->node_count; i++) {
        int32_t s = a->segment[i];
        if (a->kind[i] > NODE_SLIDING || s < -1 || s >= SEGMENT_COUNT) return false;
        if (a->kind[i] != NODE_FREE && (s < 0 || (bones && !bones->part[s].vertex_count))) return false;
    }
    for (int32_t i = 0; i < a->pair_count; i++)
        if (a->pair[2 * (size_t)i] == a->pair[2 * (size_t)i + 1]) return false;
    return all_finite(a->normal, 3 * (int64_t)a->node_count) &&
           all_within(a->pair, 2 * (int64_t)a->pair_count, 0, a->node_count) &&
           all_finite(a->pair_normal, 3 * (int64_t)a->pair_count);
}

bool tissue_is_sound(const tissue *t, const segments *bones)
{
    err ignored = {0};
    if (!tetmesh_check(&t->mesh, &ignored) || t->attach.node_count != t->mesh.vertex_count) return false;
    for (int32_t i = 0; i < t->mesh.vertex_count; i++)
        if (t->side[i] > SIDE_CUT) return false;
    return all_within(t->mesh.region, t->mesh.tet_count, REGION_LOWER, REGION_UPPER + 1) &&
           attachment_is_sound(&t->attach, bones) && frame_is_sound(&t->lips.frame) && all_finite(t->lips.x, 3) &&
           all_finite(t->lips.z, 3);
}

bool embedding_is_sound(const embedding *m, int32_t points, int32_t tets)
{
    return m->point_count == points && all_within(m->tet, points, -1, tets) &&
           all_finite(m->weight, 4 * (int64_t)points);
}

bool prepared_is_sound(const prepared *p)
{
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (!surface_is_sound(&p->segments.part[s])) return false;
    return points_are_sound(&p->points) && frame_is_sound(&p->frame) && p->skin.triangle_count &&
           surface_is_sound(&p->skin) && surface_is_sound(&p->segments.kerf) &&
           tissue_is_sound(&p->tissue, &p->segments) && bone_fields_sound(&p->fields, &p->segments) &&
           embedding_is_sound(&p->skin_on_tissue, p->skin.vertex_count, p->tissue.mesh.tet_count) &&
           json_is_object(p->report);
}
