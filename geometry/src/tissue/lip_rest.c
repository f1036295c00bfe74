#include "geometry/lip_rest.h"
#include "geometry/incisor.h"
#include "geometry/mem.h"
#include "geometry/molar.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>

lip_rest_params lip_rest_params_default(double vestibule_lower_mm)
{
    return (lip_rest_params){.reach_mm = 8, .touch_mm = 0.3, .depth_mm = vestibule_lower_mm};
}

/* The front teeth, in the head frame: in front of the first molars, from the incisal edge down into the
 * vestibule. */
typedef struct front {
    double back, top, bottom;
} front;

static bool find_front(const landmarks *l, const head_frame *f, double depth_mm, front *out)
{
    incisor edge;
    molar left, right;
    double a[3], b[3], c[3];
    if (!incisor_find(l, false, &edge) || !molar_find(l, false, 1, &left) || !molar_find(l, false, -1, &right))
        return false;
    head_frame_to_local(f, edge.xyz, a);
    head_frame_to_local(f, left.xyz, b);
    head_frame_to_local(f, right.xyz, c);
    *out = (front){.back = (b[1] + c[1]) / 2, .top = a[2], .bottom = a[2] - depth_mm};
    return true;
}

/* Nodes that may be lining: free, on the mouth's side of the tissue, of the lower lip and not on the lip
 * line. */
static uint8_t *find_lining(const tissue *t, const attach_map *a)
{
    uint8_t *lining = NEW_ARRAY(uint8_t, t->mesh.vertex_count);
    for (size_t i = 0; i < 4 * (size_t)t->mesh.tet_count; i++)
        if (t->mesh.region[i / 4] == REGION_LOWER) lining[t->mesh.tet[i]] = 1;
    for (int32_t i = 0; i < 2 * a->pair_count; i++) lining[a->pair[i]] = 0;
    for (int32_t v = 0; v < t->mesh.vertex_count; v++)
        lining[v] &= a->kind[v] == NODE_FREE && (t->side[v] == SIDE_HOLE || t->side[v] == SIDE_BONE);
    return lining;
}

/* How far forward the lower teeth come against the upper ones at x. */
static double advance_at(const rigid motion[SEGMENT_COUNT], const head_frame *f, const double x[3])
{
    double low[3], up[3], d[3];
    rigid_apply(&motion[SEGMENT_DISTAL], x, low);
    rigid_apply(&motion[SEGMENT_MAXILLA], x, up);
    vec_sub(low, up, d);
    return -vec_dot(d, f->posterior);
}

int32_t lip_rest(const tissue *t, const nearest *mandible, const rigid motion[SEGMENT_COUNT], const landmarks *l,
                 const head_frame *f, const lip_rest_params *p, attach_map *a)
{
    front teeth;
    int32_t count = 0;
    if (!mandible || !find_front(l, f, p->depth_mm, &teeth)) return 0;
    uint8_t *lining = find_lining(t, a);
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        const double *x = t->mesh.xyz + 3 * (size_t)v;
        double local[3], at[3], off[3], advance = advance_at(motion, f, x);
        if (!lining[v] || !(advance > 0)) continue;
        head_frame_to_local(f, x, local);
        if (local[1] > teeth.back || local[2] > teeth.top || local[2] < teeth.bottom) continue;
        double gap = nearest_point(mandible, x, at, NULL);
        vec_sub(x, at, off);
        if (gap < p->touch_mm || gap > p->reach_mm || -vec_dot(off, f->posterior) < 0.5 * gap) continue;
        if (!a->shift_mm) a->shift_mm = NEW_ARRAY(double, a->node_count);
        a->kind[v] = NODE_SLIDING;
        a->segment[v] = SEGMENT_DISTAL;
        a->shift_mm[v] = -fmin(gap, advance);
        vec_scale(off, 1 / gap, a->normal + 3 * (size_t)v);
        count++;
    }
    free(lining);
    return count;
}
