#include "app/planner/predict/plan_contact.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double watch_mm = 3;          /* nodes farther from every bone than this and its move are not asked */
static const double depth_limit_mm = 0.05; /* of the smooth bone; what is left to 0.1 mm is its error */

static const char *const kind_name[] = {"off", "bones", "lips"};

enum { UPPER = 1, LOWER = 2 };

bool contact_kind_find(const char *name, contact_kind *out)
{
    for (int k = 0; k <= CONTACT_LIPS; k++)
        if (strcmp(name, kind_name[k]) == 0) {
            *out = (contact_kind)k;
            return true;
        }
    return false;
}

/* The longest way between any two segments from one place. */
static double slip_at(const rigid motion[SEGMENT_COUNT], const bone_shapes *s, const double x[3])
{
    double longest = 0, at[SEGMENT_COUNT][3];
    for (int a = 0; a < SEGMENT_COUNT; a++) {
        rigid_apply(&motion[a], x, at[a]);
        for (int b = 0; b < a; b++)
            if (s->trees.part[a] && s->trees.part[b]) longest = fmax(longest, vec_distance(at[a], at[b]));
    }
    return longest;
}

/* Free nodes on the tissue's surface that a bone can come near. */
static void find_extra(const tissue *t, const attach_map *a, const rigid motion[SEGMENT_COUNT], const bone_shapes *s,
                       double more_mm, plan_contact *c)
{
    c->extra = NEW_ARRAY(int32_t, t->mesh.vertex_count);
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        const double *x = t->mesh.xyz + 3 * (size_t)v;
        bool near = false;
        double slip = rest_gap_asks(t, v) && a->kind[v] == NODE_FREE ? slip_at(motion, s, x) : 0;
        for (int k = 0; slip > 0 && !near && k < SEGMENT_COUNT; k++)
            near = s->gap.part[k] && fabs(s->gap.part[k][v]) < slip + more_mm + watch_mm;
        if (near) c->extra[c->setup.extra_count++] = v;
    }
    c->setup.extra = c->extra;
}

/* Boundary faces of one lip that look at the other one: at least one corner is paired, none is the other
 * lip's. */
static int32_t *make_lip(const tissue *t, const uint8_t *lip, const double *normal, int side, const int32_t *face,
                         int32_t faces, int32_t *count)
{
    int32_t *out = NEW_ARRAY(int32_t, 3 * (size_t)faces);
    *count = 0;
    for (int32_t f = 0; f < faces; f++) {
        const int32_t *v = face + 3 * (size_t)f;
        double up[3] = {0}, a[3], b[3], n[3];
        bool own = false, other = false;
        for (int k = 0; k < 3; k++) {
            own |= lip[v[k]] == side;
            other |= lip[v[k]] != 0 && lip[v[k]] != side;
            if (lip[v[k]] == side) vec_add(up, normal + 3 * (size_t)v[k], up);
        }
        if (!own || other) continue;
        vec_sub(t->mesh.xyz + 3 * (size_t)v[1], t->mesh.xyz + 3 * (size_t)v[0], a);
        vec_sub(t->mesh.xyz + 3 * (size_t)v[2], t->mesh.xyz + 3 * (size_t)v[0], b);
        vec_cross(a, b, n);
        double cosine = vec_dot(n, up) / (vec_norm(n) * vec_norm(up)) * (side == UPPER ? -1 : 1);
        if (cosine > 0.8) memcpy(out + 3 * (size_t)(*count)++, v, 3 * sizeof *v);
    }
    return out;
}

/* Where the lips grow together a corner can be in faces of both: it belongs to neither. */
static void part_lips(int32_t nodes, int32_t *upper, int32_t *upper_count, int32_t *lower, int32_t *lower_count)
{
    uint8_t *used = NEW_ARRAY(uint8_t, nodes);
    int32_t *face[2] = {upper, lower}, *count[2] = {upper_count, lower_count};
    for (int side = 0; side < 2; side++)
        for (int32_t i = 0; i < 3 * *count[side]; i++) used[face[side][i]] |= (uint8_t)(1 << side);
    for (int side = 0; side < 2; side++) {
        int32_t kept = 0;
        for (int32_t f = 0; f < *count[side]; f++) {
            const int32_t *v = face[side] + 3 * (size_t)f;
            if (used[v[0]] == 3 || used[v[1]] == 3 || used[v[2]] == 3) continue;
            memmove(face[side] + 3 * (size_t)kept++, v, 3 * sizeof *v);
        }
        *count[side] = kept;
    }
    free(used);
}

static void find_lips(const tissue *t, const attach_map *a, plan_contact *c)
{
    int32_t n = t->mesh.vertex_count, *face = NULL, faces = tetmesh_boundary(&t->mesh, &face, NULL);
    uint8_t *lip = NEW_ARRAY(uint8_t, n);
    double *normal = NEW_ARRAY(double, 3 * (size_t)n);
    for (int32_t i = 0; i < 2 * a->pair_count; i++) {
        int32_t v = a->pair[i];
        lip[v] = i % 2 ? LOWER : UPPER;
        vec_copy(a->pair_normal + 3 * (size_t)(i / 2), normal + 3 * (size_t)v);
    }
    c->upper = make_lip(t, lip, normal, UPPER, face, faces, &c->setup.upper_count);
    c->lower = make_lip(t, lip, normal, LOWER, face, faces, &c->setup.lower_count);
    part_lips(n, c->upper, &c->setup.upper_count, c->lower, &c->setup.lower_count);
    if (!c->setup.upper_count || !c->setup.lower_count) c->setup.upper_count = c->setup.lower_count = 0;
    c->setup.upper_lip = c->upper;
    c->setup.lower_lip = c->lower;
    free(face);
    free(lip);
    free(normal);
}

/* Is the node, carried by its own bone, in another one or right through it? */
static bool is_run_over(const bone_shapes *s, const rigid motion[SEGMENT_COUNT], int own, const double x[3])
{
    double moved[3], at[3], back[3], hit[3], normal[3];
    rigid_apply(&motion[own], x, moved);
    for (int k = 0; k < SEGMENT_COUNT; k++) {
        if (k == own || !s->trees.part[k]) continue;
        rigid back_k = rigid_inverse(&motion[k]);
        rigid_apply(&back_k, moved, at);
        vec_sub(x, at, back);
        double gone = vec_normalize(back);
        if (gone > 0 &&
            (nearest_inside(s->trees.part[k], at) || distance_field_leave(s->field[k], at, back, gone, hit, normal)))
            return true;
    }
    return false;
}

int32_t plan_contact_release(const tissue *t, const bone_shapes *bones, const rigid motion[SEGMENT_COUNT],
                             attach_map *attach)
{
    uint8_t *loose = NEW_ARRAY(uint8_t, attach->node_count);
    int32_t count = 0;
    for (int32_t v = 0; v < attach->node_count; v++)
        loose[v] = attach->kind[v] == NODE_SLIDING &&
                   is_run_over(bones, motion, attach->segment[v], t->mesh.xyz + 3 * (size_t)v);
    for (int32_t f = 0; f < t->mesh.tet_count; f++) {
        const int32_t *v = t->mesh.tet + 4 * (size_t)f;
        bool next = false;
        for (int k = 0; k < 4; k++) next = next || loose[v[k]] == 1;
        for (int k = 0; k < 4; k++)
            if (next && !loose[v[k]] && attach->kind[v[k]] == NODE_SLIDING) loose[v[k]] = 2;
    }
    for (int32_t v = 0; v < attach->node_count; v++) {
        if (!loose[v]) continue;
        attach->kind[v] = NODE_FREE;
        attach->segment[v] = -1;
        count++;
    }
    free(loose);
    return count;
}

void plan_contact_make(contact_kind kind, const tissue *t, const bone_shapes *bones, const attach_map *attach,
                       const rigid motion[SEGMENT_COUNT], double young_kpa, double more_mm, plan_contact *out)
{
    *out = (plan_contact){.setup = {.params = contact_params_default(), .held = kind == CONTACT_BONES}};
    out->setup.params.pressure_kpa = young_kpa;
    out->setup.params.depth_limit_mm = depth_limit_mm;
    for (int k = 0; k < SEGMENT_COUNT; k++)
        if (bones->trees.part[k]) out->setup.shape[k] = &bones->shape[k];
    find_extra(t, attach, motion, bones, more_mm, out);
    if (kind == CONTACT_LIPS) find_lips(t, attach, out);
}

void plan_contact_free(plan_contact *c)
{
    free(c->extra);
    free(c->upper);
    free(c->lower);
    *c = (plan_contact){0};
}
