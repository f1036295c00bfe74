#include "geometry/src/tissue/tissue_attach.h"
#include "geometry/incisor.h"
#include "geometry/mem.h"
#include "geometry/molar.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

/* The zone of one jaw where mucosa slides over crowns and alveolar bone: within depth_mm of the occlusal plane on the
 * jaw's side (and 3 mm beyond it), in front of the last molar. */
typedef struct vestibule {
    bool known;
    double edge[3], away[3]; /* incisal edge; unit, from the occlusal plane into the jaw */
    double front[3];         /* unit, forward along the plane */
    double back_mm, depth_mm;
} vestibule;

static bool is_upper_jaw(int segment) { return segment == SEGMENT_CRANIUM || segment == SEGMENT_MAXILLA; }

static vestibule find_vestibule(const landmarks *l, const head_frame *f, bool upper, double depth_mm)
{
    vestibule z = {.depth_mm = depth_mm};
    incisor front;
    molar left, right;
    if (!incisor_find(l, upper, &front) || !molar_find(l, upper, 1, &left) || !molar_find(l, upper, -1, &right))
        return z;
    double middle[3], across[3], along[3];
    for (int c = 0; c < 3; c++) middle[c] = (left.xyz[c] + right.xyz[c]) / 2;
    vec_copy(front.xyz, z.edge);
    vec_sub(left.xyz, right.xyz, across);
    vec_sub(middle, front.xyz, along); /* backwards */
    vec_cross(across, along, z.away);  /* left x posterior = up */
    vec_normalize(z.away);
    if ((vec_dot(z.away, f->up) > 0) != upper) vec_scale(z.away, -1, z.away);
    vec_scale(along, -1 / vec_norm(along), z.front);
    z.back_mm = vec_norm(along) + 20; /* first molar's cusp to behind the second molar */
    z.known = true;
    return z;
}

static bool in_vestibule(const vestibule *z, const double p[3])
{
    double d[3];
    vec_sub(p, z->edge, d);
    double depth = vec_dot(d, z->away);
    return z->known && depth > -3 && depth < z->depth_mm && -vec_dot(d, z->front) < z->back_mm;
}

typedef struct bone_trees {
    nearest *part[SEGMENT_COUNT], *kerf;
} bone_trees;

static void trees_destroy(bone_trees *b)
{
    for (int s = 0; s < SEGMENT_COUNT; s++) nearest_destroy(&b->part[s]);
    nearest_destroy(&b->kerf);
}

static bool trees_make(const segments *segs, bone_trees *b, err *e)
{
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (segs->part[s].triangle_count && !nearest_create(&segs->part[s], &b->part[s], e)) return false;
    return !segs->kerf.triangle_count || nearest_create(&segs->kerf, &b->kerf, e);
}

/* Do these two pieces stay together in every plan? A proximal segment keeps its condyle seated. */
static bool move_as_one(int a, int b)
{
    bool still_a = a == SEGMENT_CRANIUM || a == SEGMENT_PROXIMAL_LEFT || a == SEGMENT_PROXIMAL_RIGHT;
    bool still_b = b == SEGMENT_CRANIUM || b == SEGMENT_PROXIMAL_LEFT || b == SEGMENT_PROXIMAL_RIGHT;
    return a == b || (still_a && still_b);
}

/* The segment a bone node touches, and its distance to the nearest other one that may move against it. */
static int nearest_segment(const bone_trees *b, const double p[3], double *gap_to_other)
{
    double gap[SEGMENT_COUNT];
    int best = -1;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        gap[s] = b->part[s] ? nearest_point(b->part[s], p, NULL, NULL) : HUGE_VAL;
        if (best < 0 || gap[s] < gap[best]) best = s;
    }
    *gap_to_other = HUGE_VAL;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (!move_as_one(best, s)) *gap_to_other = fmin(*gap_to_other, gap[s]);
    return best;
}

/* Distance to the bones that a plan can move forward or back. */
static double gap_to_moving(const bone_trees *b, const double p[3])
{
    static const int moving[] = {SEGMENT_MAXILLA, SEGMENT_DISTAL, SEGMENT_CHIN};
    double gap = HUGE_VAL;
    for (int i = 0; i < 3; i++)
        if (b->part[moving[i]]) gap = fmin(gap, nearest_point(b->part[moving[i]], p, NULL, NULL));
    return gap;
}

static const double bite_band_mm = 1.5; /* mucosa between upper and lower teeth belongs to neither */

static void tie(attach_map *a, int32_t v, int segment)
{
    a->kind[v] = NODE_TIED;
    a->segment[v] = segment;
}

/* Frees the nodes of tets that hang on two bones which may move against each other: such a tet would take their whole
 * jump on a few mm. */
static void loosen_bridges(const tetmesh *m, attach_map *a, tissue_report *report)
{
    uint8_t *bridge = NEW_ARRAY(uint8_t, m->vertex_count);
    for (int32_t t = 0; t < m->tet_count; t++) {
        const int32_t *v = m->tet + 4 * (size_t)t;
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < i; j++)
                if (a->kind[v[i]] != NODE_FREE && a->kind[v[j]] != NODE_FREE &&
                    !move_as_one(a->segment[v[i]], a->segment[v[j]]))
                    bridge[v[i]] = bridge[v[j]] = 1;
    }
    for (int32_t v = 0; v < m->vertex_count; v++) {
        if (!bridge[v]) continue;
        a->kind[v] = NODE_FREE;
        a->segment[v] = -1;
        memset(a->normal + 3 * (size_t)v, 0, 3 * sizeof *a->normal);
        report->loose_nodes++;
    }
    free(bridge);
}

/* Sliding normals come from the distance field of the wrap; averaging over sliding neighbours takes out the relief
 * of single teeth, over which mucosa glides. */
static void smooth_normals(const tetmesh *m, attach_map *a)
{
    double *sum = NEW_ARRAY(double, 3 * (size_t)m->vertex_count);
    for (int pass = 0; pass < 3; pass++) {
        memcpy(sum, a->normal, 3 * (size_t)m->vertex_count * sizeof *sum);
        for (int32_t t = 0; t < m->tet_count; t++)
            for (int i = 0; i < 4; i++)
                for (int j = 0; j < 4; j++) {
                    int32_t v = m->tet[4 * (size_t)t + (size_t)i], w = m->tet[4 * (size_t)t + (size_t)j];
                    if (i == j || a->kind[v] != NODE_SLIDING || a->kind[w] != NODE_SLIDING ||
                        a->segment[v] != a->segment[w])
                        continue;
                    vec_axpy(sum + 3 * (size_t)v, 0.2, a->normal + 3 * (size_t)w, sum + 3 * (size_t)v);
                }
        for (int32_t v = 0; v < m->vertex_count; v++) vec_normalize(sum + 3 * (size_t)v);
        memcpy(a->normal, sum, 3 * (size_t)m->vertex_count * sizeof *sum);
    }
    free(sum);
}

bool tissue_attach(const tissue_input *in, const tissue_domain *d, const tetmesh *m, const uint8_t *side,
                   const lip_pairs *lips, attach_map *out, tissue_report *report, err *e)
{
    bone_trees bones = {0};
    if (!trees_make(in->segments, &bones, e)) {
        trees_destroy(&bones);
        return false;
    }
    attach_map a = attach_map_new(m->vertex_count, lips->count);
    vestibule upper = find_vestibule(in->landmarks, in->frame, true, d->params->vestibule_upper_mm);
    vestibule lower = find_vestibule(in->landmarks, in->frame, false, d->params->vestibule_lower_mm);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        const double *p = m->xyz + 3 * (size_t)v;
        double gap;
        if (side[v] == SIDE_SKIN) report->skin_nodes++;
        if (side[v] == SIDE_HOLE) report->hole_nodes++;
        if (side[v] == SIDE_CUT) {
            if (gap_to_moving(&bones, p) < d->params->far_mm) continue;
            tie(&a, v, SEGMENT_CRANIUM);
            report->fixed_nodes++;
        }
        if (side[v] != SIDE_BONE) continue;
        if (bones.kerf && nearest_point(bones.kerf, p, NULL, NULL) < d->params->cut_band_mm) {
            report->loose_nodes++;
            continue;
        }
        int segment = nearest_segment(&bones, p, &gap);
        bool slides = in_vestibule(is_upper_jaw(segment) ? &upper : &lower, p);
        if (gap < (slides ? bite_band_mm : d->params->cut_band_mm)) {
            report->loose_nodes++; /* between two bones that part: condyle and fossa, upper and lower teeth */
            continue;
        }
        tie(&a, v, segment);
        if (!slides) continue;
        a.kind[v] = NODE_SLIDING;
        sdf_grid_normal(&d->wrap, p, a.normal + 3 * (size_t)v);
        if (vec_norm(a.normal + 3 * (size_t)v) < 0.5) tie(&a, v, segment); /* no direction to slide in */
    }
    loosen_bridges(m, &a, report);
    smooth_normals(m, &a);
    for (int32_t v = 0; v < m->vertex_count; v++) {
        report->tied_nodes += a.kind[v] == NODE_TIED;
        report->sliding_nodes += a.kind[v] == NODE_SLIDING;
    }
    a.pair_count = 0;
    for (int32_t i = 0; i < lips->count; i++) {
        int32_t up = lips->node[2 * i], low = lips->node[2 * i + 1];
        if (a.kind[up] != NODE_FREE || a.kind[low] != NODE_FREE) continue;
        double local[3];
        head_frame_to_local(&d->frame, m->xyz + 3 * (size_t)up, local);
        a.pair[2 * a.pair_count] = up;
        a.pair[2 * a.pair_count + 1] = low;
        lip_sheet_normal(&d->lips, local[0], a.pair_normal + 3 * (size_t)a.pair_count++);
    }
    report->lip_pairs = a.pair_count;
    trees_destroy(&bones);
    *out = a;
    return true;
}
