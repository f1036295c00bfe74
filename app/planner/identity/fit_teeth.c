#include "app/planner/identity/fit_teeth.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/motion.h"
#include <stdlib.h>
#include <string.h>

static const target_rules near_by = {1.5, 0.7};
static const double size_range = 0.1;
enum { ROUNDS = 8 };

/* Turn and shift by equal weights: points without weight are left out. */
similarity similarity_fit(const double *from, const double *to, const double *weight, int32_t count)
{
    double *a = NEW_ARRAY(double, 3 * (size_t)count), *b = NEW_ARRAY(double, 3 * (size_t)count), up = 0, down = 0;
    double ca[3] = {0}, cb[3] = {0};
    int32_t n = 0;
    for (size_t i = 0; i < (size_t)count; i++) {
        if (!(weight[i] > 0)) continue;
        vec_copy(from + 3 * i, a + 3 * (size_t)n);
        vec_copy(to + 3 * i, b + 3 * (size_t)n++);
        vec_add(ca, from + 3 * i, ca);
        vec_add(cb, to + 3 * i, cb);
    }
    similarity s = {1, motion_fit(a, b, n)};
    for (int c = 0; n && c < 3; c++) {
        ca[c] /= n;
        cb[c] /= n;
    }
    for (size_t i = 0; i < (size_t)n; i++) {
        double p[3], q[3];
        vec_sub(a + 3 * i, ca, p);
        vec_sub(b + 3 * i, cb, q);
        rigid_rotate(&s.motion, p, p);
        up += vec_dot(p, q);
        down += vec_dot(p, p);
    }
    if (n >= 3 && down > 0 && up > 0) s.scale = up / down;
    double turned[3];
    rigid_rotate(&s.motion, ca, turned);
    vec_axpy(cb, -s.scale, turned, s.motion.t);
    free(a);
    free(b);
    return s;
}

/* A tooth's vertices: as in the template, and where they are. */
typedef struct crown {
    int32_t count, *vertex;
    double *as, *at, *weight;
} crown;

static void put(const similarity *s, const crown *c)
{
    for (size_t i = 0; i < (size_t)c->count; i++) similarity_apply(s, c->as + 3 * i, c->at + 3 * i);
}

static void find_places(const surface *moved, const crown *c, const target_surface *target, double *place)
{
    double *normal = surface_vertex_normals(moved);
    for (size_t i = 0; i < (size_t)c->count; i++) {
        target_point hit;
        double d = target_surface_ask(target, c->at + 3 * i, normal + 3 * (size_t)c->vertex[i], &near_by, &hit);
        c->weight[i] = d < HUGE_VAL;
        if (c->weight[i] > 0) vec_copy(hit.at, place + 3 * i);
    }
    free(normal);
}

static void fit_one(const target_surface *target, surface *moved, const crown *c)
{
    double *place = COPY_ARRAY(double, c->at, 3 * (size_t)c->count);
    for (int32_t i = 0; i < c->count; i++) c->weight[i] = 1;
    similarity s = similarity_fit(c->as, place, c->weight, c->count);
    double size = s.scale;
    put(&s, c);
    for (int round = 0; target && round < ROUNDS; round++) {
        for (size_t i = 0; i < (size_t)c->count; i++) vec_copy(c->at + 3 * i, moved->xyz + 3 * (size_t)c->vertex[i]);
        find_places(moved, c, target, place);
        int32_t found = 0;
        for (int32_t i = 0; i < c->count; i++) found += c->weight[i] > 0;
        if (4 * found < c->count) break; /* too little of it is there to tell where it stands */
        s = similarity_fit(c->as, place, c->weight, c->count);
        if (fabs(s.scale / size - 1) > size_range) break;
        put(&s, c);
    }
    for (size_t i = 0; i < (size_t)c->count; i++) vec_copy(c->at + 3 * i, moved->xyz + 3 * (size_t)c->vertex[i]);
    free(place);
}

void fit_teeth(const surface *as, const int32_t *tooth, const target_surface *target, surface *moved)
{
    size_t n = (size_t)as->vertex_count;
    int32_t teeth = 0;
    crown c = {.vertex = NEW_ARRAY(int32_t, n),
               .as = NEW_ARRAY(double, 3 * n),
               .at = NEW_ARRAY(double, 3 * n),
               .weight = NEW_ARRAY(double, n)};
    for (size_t v = 0; v < n; v++) teeth = tooth[v] >= teeth ? tooth[v] + 1 : teeth;
    for (int32_t k = 0; k < teeth; k++) {
        c.count = 0;
        for (size_t v = 0; v < n; v++) {
            if (tooth[v] != k) continue;
            vec_copy(as->xyz + 3 * v, c.as + 3 * (size_t)c.count);
            vec_copy(moved->xyz + 3 * v, c.at + 3 * (size_t)c.count);
            c.vertex[c.count++] = (int32_t)v;
        }
        if (c.count) fit_one(target, moved, &c);
    }
    free(c.vertex);
    free(c.as);
    free(c.at);
    free(c.weight);
}
