#include "app/colliders.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double region_mm = 15; /* around sliding nodes and lips */
static const double label_mm = 8;   /* a loose node on bone counts to the nearest held one's segment */

enum { UPPER = 1, LOWER = 2 };

/* Distance to the nearest node with `mark`, and its number. */
static double nearest_marked(const double *xyz, int32_t count, const uint8_t *mark, const double p[3], int32_t *which)
{
    double best = HUGE_VAL;
    for (int32_t v = 0; v < count; v++) {
        double d = mark[v] ? vec_distance(p, xyz + 3 * (size_t)v) : HUGE_VAL;
        if (d >= best) continue;
        best = d;
        *which = v;
    }
    return best;
}

/* The segment of each node of the bone side near the mouth, else -1. */
static int32_t *label_nodes(const tissue *t, const attach_map *a, const uint8_t *mouth)
{
    int32_t n = t->mesh.vertex_count, *label = NEW_ARRAY(int32_t, n);
    uint8_t *held = NEW_ARRAY(uint8_t, n);
    for (int32_t v = 0; v < n; v++) held[v] = t->side[v] == SIDE_BONE && a->kind[v] != NODE_FREE;
    for (int32_t v = 0; v < n; v++) {
        const double *p = t->mesh.xyz + 3 * (size_t)v;
        int32_t at = -1;
        label[v] = -1;
        if (t->side[v] != SIDE_BONE || nearest_marked(t->mesh.xyz, n, mouth, p, &at) > region_mm) continue;
        if (nearest_marked(t->mesh.xyz, n, held, p, &at) <= label_mm) label[v] = a->segment[at];
    }
    free(held);
    return label;
}

/* The segment that most corners of a face have; of three different ones the first. */
static int32_t face_label(const int32_t *label, const int32_t v[3])
{
    if (label[v[0]] < 0 || label[v[1]] < 0 || label[v[2]] < 0) return -1;
    return label[v[1]] == label[v[2]] ? label[v[1]] : label[v[0]];
}

static void make_bones(const tissue *t, const int32_t *label, const int32_t *face, int32_t faces, colliders *c)
{
    surface whole = {.vertex_count = t->mesh.vertex_count, .triangle_count = faces, .xyz = t->mesh.xyz,
                     .tri = (int32_t *)face};
    uint8_t *keep = NEW_ARRAY(uint8_t, faces);
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        bool any = false;
        for (int32_t f = 0; f < faces; f++) any |= keep[f] = face_label(label, face + 3 * (size_t)f) == s;
        if (!any) continue;
        c->bone[s] = surface_select(&whole, keep);
        surface_flip(&c->bone[s]); /* out of the bone, into the tissue */
        c->setup.bone[s] = &c->bone[s];
    }
    free(keep);
}

/* Boundary faces of one lip that look at the other one: at least one corner is paired, none is the other lip's. */
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

bool colliders_make(const prepared *p, const attach_map *attach, colliders *out, err *e)
{
    const tissue *t = &p->tissue;
    int32_t n = t->mesh.vertex_count, *face = NULL, faces = tetmesh_boundary(&t->mesh, &face, NULL);
    uint8_t *mouth = NEW_ARRAY(uint8_t, n), *lip = NEW_ARRAY(uint8_t, n);
    double *normal = NEW_ARRAY(double, 3 * (size_t)n);
    bool any = false;
    *out = (colliders){.setup = {.params = contact_params_default()}};
    for (int32_t i = 0; i < 2 * attach->pair_count; i++) {
        int32_t v = attach->pair[i];
        lip[v] = i % 2 ? LOWER : UPPER;
        vec_copy(attach->pair_normal + 3 * (size_t)(i / 2), normal + 3 * (size_t)v);
    }
    for (int32_t v = 0; v < n; v++) any |= mouth[v] = attach->kind[v] == NODE_SLIDING || lip[v];
    if (any) {
        int32_t *label = label_nodes(t, attach, mouth);
        make_bones(t, label, face, faces, out);
        out->extra = NEW_ARRAY(int32_t, n);
        for (int32_t v = 0; v < n; v++)
            if (label[v] >= 0 && attach->kind[v] == NODE_FREE && !lip[v])
                out->extra[out->setup.extra_count++] = v;
        out->setup.extra = out->extra;
        free(label);
        out->upper = make_lip(t, lip, normal, UPPER, face, faces, &out->setup.upper_count);
        out->lower = make_lip(t, lip, normal, LOWER, face, faces, &out->setup.lower_count);
        part_lips(n, out->upper, &out->setup.upper_count, out->lower, &out->setup.lower_count);
        out->setup.upper_lip = out->upper;
        out->setup.lower_lip = out->lower;
    } else
        err_set(e, ERR_GEOMETRY, "contact is on, but this case has neither sliding mucosa nor lips");
    free(face);
    free(mouth);
    free(lip);
    free(normal);
    return any;
}

void colliders_free(colliders *c)
{
    for (int s = 0; s < SEGMENT_COUNT; s++) surface_free(&c->bone[s]);
    free(c->upper);
    free(c->lower);
    free(c->extra);
    *c = (colliders){0};
}
