#include "app/planner/identity/place_pairs.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const int asked[PLACE_LEVELS] = {60, 200, 600}, offered[PLACE_FINE] = {500, 1500};
static const double kept_share = 0.75, beyond = 1.5, far_mm = 12, least_alike = 0.3;

/* Twice the triangle's area, along its normal. */
static void wide_normal(const surface *s, int32_t t, double out[3])
{
    const int32_t *v = s->tri + 3 * (size_t)t;
    double u[3], w[3];
    vec_sub(s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[0], u);
    vec_sub(s->xyz + 3 * (size_t)v[2], s->xyz + 3 * (size_t)v[0], w);
    vec_cross(u, w, out);
}

static int32_t sample_part(const surface *s, int count, int part, place_side side, place_sample *out)
{
    const double golden = 0.6180339887498949;
    double n[3], whole = 0, passed = 0;
    int32_t made = 0;
    for (int32_t t = 0; t < s->triangle_count; t++) {
        wide_normal(s, t, n);
        whole += vec_norm(n);
    }
    for (int32_t t = 0; t < s->triangle_count && made < count; t++) {
        wide_normal(s, t, n);
        passed += vec_norm(n);
        for (; made < count && passed > whole * (made + 0.5) / count; made++) {
            double a = sqrt(fmod(golden * (made + 1), 1)), b = fmod(golden * golden * (made + 1) * 7, 1);
            const double weight[3] = {1 - a, a * (1 - b), a * b};
            place_sample *p = out + made;
            *p = (place_sample){.part = part, .side = side};
            for (int k = 0; k < 3; k++) vec_axpy(p->at, weight[k], s->xyz + 3 * (size_t)s->tri[3 * t + k], p->at);
            vec_copy(n, p->normal);
            vec_normalize(p->normal);
        }
    }
    return made;
}

static place_cloud cloud_of(const surface *s, int count)
{
    place_sample *p = NEW_ARRAY(place_sample, count);
    place_cloud c = {.count = sample_part(s, count, 0, PLACE_TEMPLATE, p)};
    c.at = NEW_ARRAY(double, 3 * c.count);
    c.normal = NEW_ARRAY(double, 3 * c.count);
    for (int32_t i = 0; i < c.count; i++) {
        vec_copy(p[i].at, c.at + 3 * (size_t)i);
        vec_copy(p[i].normal, c.normal + 3 * (size_t)i);
    }
    free(p);
    return c;
}

bool place_bodies_make(const head_template *t, const head_scan *s, place_bodies *out, err *e)
{
    place_bodies b = {0};
    bool ok = true;
    for (int i = 0; ok && i < PLACE_PARTS; i++) {
        const surface *mesh[2] = {&t->part[i], &s->part[i]};
        if (!mesh[0]->triangle_count || !mesh[1]->triangle_count) continue;
        for (int side = 0; ok && side < 2; side++) {
            b.mesh[side][i] = mesh[side];
            ok = nearest_create(mesh[side], &b.tree[side][i], e);
        }
        if (!ok) err_prefix(e, "%s", case_surface_name((case_surface)i));
        for (int side = 0; ok && side < 2; side++)
            for (int level = 0; level < PLACE_FINE; level++)
                b.cloud[level][side][i] = cloud_of(mesh[side], offered[level]);
    }
    if (ok)
        *out = b;
    else
        place_bodies_free(&b);
    return ok;
}

void place_bodies_free(place_bodies *b)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < PLACE_PARTS; i++) {
            nearest_destroy(&b->tree[side][i]);
            for (int level = 0; level < PLACE_FINE; level++) {
                free(b->cloud[level][side][i].at);
                free(b->cloud[level][side][i].normal);
                b->cloud[level][side][i] = (place_cloud){0};
            }
        }
}

int32_t place_samples(const place_bodies *b, place_level level, place_sample **out)
{
    int per_part = asked[level];
    place_sample *s = NEW_ARRAY(place_sample, 2 * PLACE_PARTS * per_part);
    int32_t count = 0;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < PLACE_PARTS; i++)
            if (b->tree[side][i]) count += sample_part(b->mesh[side][i], per_part, i, (place_side)side, s + count);
    *out = s;
    return count;
}

static double nearest_of(const place_cloud *c, const double p[3], double found[3], double normal[3])
{
    double least = HUGE_VAL;
    int32_t best = 0;
    for (int32_t i = 0; i < c->count; i++) {
        const double *q = c->at + 3 * (size_t)i;
        double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2], d = x * x + y * y + z * z;
        if (d >= least) continue;
        least = d;
        best = i;
    }
    vec_copy(c->at + 3 * (size_t)best, found);
    vec_copy(c->normal + 3 * (size_t)best, normal);
    return sqrt(least);
}

static void find_gap(const place_bodies *b, place_level level, const place_sample *s, const similarity *way,
                     const similarity *back, place_gap *out)
{
    double own[3], at[3], normal[3];
    place_side other = s->side == PLACE_SCAN ? PLACE_TEMPLATE : PLACE_SCAN;
    const nearest *tree = b->tree[other][s->part];
    similarity_apply(s->side == PLACE_SCAN ? back : way, s->at, at);
    if (level != PLACE_FINE) {
        out->distance_mm = nearest_of(&b->cloud[level][other][s->part], at, out->found, normal);
    } else {
        out->distance_mm = out->known ? nearest_point_onward(tree, at, out->found, &out->triangle)
                                      : nearest_point(tree, at, out->found, &out->triangle);
        out->known = true;
        wide_normal(b->mesh[other][s->part], out->triangle, normal);
        vec_normalize(normal);
    }
    vec_copy(s->normal, own);
    if (s->side == PLACE_SCAN) { /* found in the template */
        out->distance_mm *= way->scale;
        rigid_rotate(&way->motion, normal, normal);
        similarity_apply(way, out->found, out->pair.at);
        vec_copy(s->at, out->pair.to);
    } else {
        rigid_rotate(&way->motion, own, own);
        vec_copy(at, out->pair.at);
        vec_copy(out->found, out->pair.to);
    }
    vec_copy(normal, out->pair.normal);
    out->alike = vec_dot(own, normal);
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Distance that the kept share of the scan's points of a part do not exceed. */
static double limit_of(const place_sample *s, const place_gap *g, int32_t count, int part, double *sorted)
{
    int32_t n = 0;
    for (int32_t i = 0; i < count; i++)
        if (s[i].side == PLACE_SCAN && s[i].part == part) sorted[n++] = g[i].distance_mm;
    qsort(sorted, (size_t)n, sizeof *sorted, by_size);
    return n ? sorted[(int32_t)(kept_share * (n - 1))] : 0;
}

double place_pair_up(const place_bodies *b, place_level level, const place_sample *s, int32_t count,
                     const similarity *way, place_facing facing, place_gap *out)
{
    similarity back = similarity_inverse(way);
    double *sorted = NEW_ARRAY(double, count), most[PLACE_PARTS], score = 0, sum = 0;
    for (int32_t i = 0; i < count; i++) find_gap(b, level, s + i, way, &back, out + i);
    for (int i = 0; i < PLACE_PARTS; i++) most[i] = limit_of(s, out, count, i, sorted);
    free(sorted);
    for (int32_t i = 0; i < count; i++) {
        place_gap *g = out + i;
        bool scan = s[i].side == PLACE_SCAN;
        double w = scan ? 1 : 0.5, alike = facing == FACING_ANY ? fabs(g->alike) : g->alike;
        bool near = g->distance_mm <= (scan ? 1 : beyond) * most[s[i].part] + 1e-9;
        g->pair.weight = near && (facing == FACING_ANY || alike > least_alike);
        score += w * fmin(g->distance_mm, far_mm);
        sum += w;
    }
    return score / sum;
}
