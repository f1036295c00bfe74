#include "geometry/plan_attach.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

plan_attach_params plan_attach_params_default(double cut_band_mm)
{
    return (plan_attach_params){.cut_mm = cut_band_mm, .bared_mm = 2 * cut_band_mm, .edge_mm = 0.5};
}

typedef struct field {
    const tissue *t;
    const rigid *motion;
    const rest_gap *gap;
} field;

static bool moves_as(const field *f, int a, int b)
{
    return a == b || memcmp(&f->motion[a], &f->motion[b], sizeof *f->motion) == 0;
}

/* Is a the piece that is carried away from b? */
static bool is_carried(int a, int b)
{
    static const int rank[SEGMENT_COUNT] = {[SEGMENT_MAXILLA] = 1, [SEGMENT_DISTAL] = 1, [SEGMENT_CHIN] = 2};
    return rank[a] > rank[b];
}

/* The segment a node touches; *other is the nearest one that moves otherwise, -1 if none, at *gap mm. */
static int touched(const field *f, int32_t v, int *other, double *gap)
{
    double to[SEGMENT_COUNT];
    int best = -1;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        to[s] = f->gap->part[s] ? fabs(f->gap->part[s][v]) : HUGE_VAL;
        if (best < 0 || to[s] < to[best]) best = s;
    }
    *gap = HUGE_VAL;
    *other = -1;
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (!moves_as(f, s, best) && to[s] < *gap) {
            *gap = to[s];
            *other = s;
        }
    return best;
}

static void loosen(attach_map *a, int32_t v)
{
    a->kind[v] = NODE_FREE;
    a->segment[v] = -1;
}

static void settle(const field *f, const plan_attach_params *p, int32_t v, attach_map *a, plan_attach_report *r)
{
    int other;
    double gap;
    if (a->kind[v] == NODE_SLIDING) return;
    double saw = fabs(f->gap->kerf[v]);
    if (a->kind[v] == NODE_FREE ? saw >= p->cut_mm : saw >= p->bared_mm) return;
    int segment = touched(f, v, &other, &gap);
    bool carried = other < 0 || is_carried(segment, other);
    bool hold = gap > (carried ? p->edge_mm : p->bared_mm);
    if (hold && a->kind[v] == NODE_FREE) {
        a->kind[v] = NODE_TIED;
        a->segment[v] = segment;
        r->tied++;
    } else if (!hold && a->kind[v] == NODE_TIED) {
        loosen(a, v);
        r->loosened++;
    }
}

/* A node that was tied alone, in no tet with two more nodes of its segment, would be a thorn in the tissue. */
static void pull_thorns(const tissue *t, attach_map *a, plan_attach_report *r)
{
    uint8_t *rooted = NEW_ARRAY(uint8_t, t->mesh.vertex_count);
    for (int32_t i = 0; i < t->mesh.tet_count; i++) {
        const int32_t *v = t->mesh.tet + 4 * (size_t)i;
        for (int k = 0; k < 4; k++) {
            int same = 0;
            for (int j = 0; j < 4; j++) same += a->kind[v[j]] != NODE_FREE && a->segment[v[j]] == a->segment[v[k]];
            rooted[v[k]] |= same >= 3;
        }
    }
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        if (rooted[v] || a->kind[v] != NODE_TIED || t->attach.kind[v] != NODE_FREE) continue;
        loosen(a, v);
        r->tied--;
    }
    free(rooted);
}

/* No tet may hang on two bones that part: the one that stays lets go. */
static void part_bridges(const field *f, attach_map *a, plan_attach_report *r)
{
    const tetmesh *m = &f->t->mesh;
    uint8_t *go = NEW_ARRAY(uint8_t, m->vertex_count);
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < i; j++) {
                int32_t u = m->tet[4 * (size_t)t + (size_t)i], v = m->tet[4 * (size_t)t + (size_t)j];
                if (a->kind[u] == NODE_FREE || a->kind[v] == NODE_FREE || moves_as(f, a->segment[u], a->segment[v]))
                    continue;
                if (!is_carried(a->segment[u], a->segment[v]) && a->kind[u] == NODE_TIED) go[u] = 1;
                if (!is_carried(a->segment[v], a->segment[u]) && a->kind[v] == NODE_TIED) go[v] = 1;
            }
    for (int32_t v = 0; v < m->vertex_count; v++) {
        if (!go[v]) continue;
        loosen(a, v);
        r->loosened++;
    }
    free(go);
}

static attach_map copy_of(const attach_map *a)
{
    attach_map b = attach_map_new(a->node_count, a->pair_count);
    memcpy(b.kind, a->kind, (size_t)a->node_count);
    memcpy(b.segment, a->segment, (size_t)a->node_count * sizeof *b.segment);
    memcpy(b.normal, a->normal, 3 * (size_t)a->node_count * sizeof *b.normal);
    memcpy(b.pair, a->pair, 2 * (size_t)a->pair_count * sizeof *b.pair);
    memcpy(b.pair_normal, a->pair_normal, 3 * (size_t)a->pair_count * sizeof *b.pair_normal);
    return b;
}

void plan_attach(const tissue *t, const rest_gap *gap, const rigid motion[SEGMENT_COUNT], const plan_attach_params *p,
                 attach_map *out, plan_attach_report *report)
{
    field f = {.t = t, .motion = motion, .gap = gap};
    *report = (plan_attach_report){0};
    *out = copy_of(&t->attach);
    if (!gap->kerf) return;
    uint8_t *paired = NEW_ARRAY(uint8_t, t->mesh.vertex_count); /* the lips hang on each other */
    for (int32_t i = 0; i < 2 * out->pair_count; i++) paired[out->pair[i]] = 1;
    for (int32_t v = 0; v < t->mesh.vertex_count; v++)
        if (t->side[v] == SIDE_BONE && !paired[v]) settle(&f, p, v, out, report);
    free(paired);
    pull_thorns(t, out, report);
    part_bridges(&f, out, report);
}
