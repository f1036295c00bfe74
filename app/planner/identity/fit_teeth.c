#include "app/planner/identity/fit_teeth.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "geometry/similarity.h"
#include <stdlib.h>
#include <string.h>

static const double reach_first_mm = 3, reach_mm = 1, facing_cos = 0.7;
static const double size_range = 0.1;
enum { ROUNDS = 8 };

/* A tooth's vertices: as in the template, and where they are. */
typedef struct crown {
    int32_t count, crowns, *vertex; /* crowns: vertices out of the bone */
    double *as, *at, *weight;
    const uint8_t *buried;
} tooth_points;

static void put(const similarity *s, const tooth_points *c)
{
    for (size_t i = 0; i < (size_t)c->count; i++) similarity_apply(s, c->as + 3 * i, c->at + 3 * i);
}

static void find_places(const surface *moved, const tooth_points *c, const target_surface *target, double reach,
                        double *place)
{
    target_rules rules = {reach, facing_cos};
    double *normal = surface_vertex_normals(moved);
    for (size_t i = 0; i < (size_t)c->count; i++) {
        target_point hit;
        size_t v = (size_t)c->vertex[i];
        c->weight[i] =
            !c->buried[v] && target_surface_ask(target, c->at + 3 * i, normal + 3 * v, &rules, &hit) < HUGE_VAL;
        if (c->weight[i] > 0) vec_copy(hit.at, place + 3 * i);
    }
    free(normal);
}

static void fit_one(const target_surface *target, surface *moved, const tooth_points *c)
{
    double *place = COPY_ARRAY(double, c->at, 3 * (size_t)c->count);
    for (int32_t i = 0; i < c->count; i++) c->weight[i] = 1;
    similarity s;
    similarity_of_pairs(c->as, place, c->weight, c->count, true, &s);
    double size = s.scale;
    put(&s, c);
    for (int round = 0; target && round < ROUNDS; round++) {
        for (size_t i = 0; i < (size_t)c->count; i++) vec_copy(c->at + 3 * i, moved->xyz + 3 * (size_t)c->vertex[i]);
        find_places(moved, c, target, fmax(reach_mm, reach_first_mm * pow(0.75, round)), place);
        int32_t found = 0;
        for (int32_t i = 0; i < c->count; i++) found += c->weight[i] > 0;
        if (3 * found < c->crowns) break; /* too little of it is there to tell where it stands */
        similarity_of_pairs(c->as, place, c->weight, c->count, true, &s);
        if (fabs(s.scale / size - 1) > size_range) break;
        put(&s, c);
    }
    for (size_t i = 0; i < (size_t)c->count; i++) vec_copy(c->at + 3 * i, moved->xyz + 3 * (size_t)c->vertex[i]);
    free(place);
}

void fit_teeth(const surface *as, const int32_t *tooth, const uint8_t *buried, const target_surface *target,
               surface *moved)
{
    size_t n = (size_t)as->vertex_count;
    int32_t teeth = 0;
    tooth_points c = {.buried = buried,
                      .vertex = NEW_ARRAY(int32_t, n),
                      .as = NEW_ARRAY(double, 3 * n),
                      .at = NEW_ARRAY(double, 3 * n),
                      .weight = NEW_ARRAY(double, n)};
    for (size_t v = 0; v < n; v++) teeth = tooth[v] >= teeth ? tooth[v] + 1 : teeth;
    for (int32_t k = 0; k < teeth; k++) {
        c.count = c.crowns = 0;
        for (size_t v = 0; v < n; v++) {
            if (tooth[v] != k) continue;
            vec_copy(as->xyz + 3 * v, c.as + 3 * (size_t)c.count);
            vec_copy(moved->xyz + 3 * v, c.at + 3 * (size_t)c.count);
            c.crowns += !buried[v];
            c.vertex[c.count++] = (int32_t)v;
        }
        if (c.count) fit_one(target, moved, &c);
    }
    free(c.vertex);
    free(c.as);
    free(c.at);
    free(c.weight);
}
