/* Depth and distance: branch and bound, because neither changes faster than the point moves. Where both surfaces run
 * side by side nothing is bounded away, so that the search ends at small triangles: the extremes of flat facets lie at
 * corners, which are tried, and between tried points of a curved one the error is of second order. */
#include "geometry/mem.h"
#include "geometry/src/distance/clash_body.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double small_mm = 0.7, settled_mm = 1, near_mm = 1.5, finest_distance_mm = 0.05, finest_share = 0.3;
enum { SPLIT_DEPTH = 12 };

typedef struct hunt {
    const clash_body *other;
    rigid to_other;
    bool depth;   /* the largest depth, else the least distance */
    double best;  /* so far: depth, or distance */
    double at[3]; /* in the frame of `other` */
    bool found;
} hunt;

typedef struct look { /* what the grid alone knows of a point */
    bool inside;
    double clear; /* the other surface is at least so far */
} look;

static look look_at(const hunt *h, const double p[3])
{
    look l;
    l.inside = solid_grid_look(h->other->grid, p, &l.clear);
    return l;
}

/* No point within this radius can be better than the best by more than this. */
static bool hopeless(const hunt *h, const look *l, double radius, double by)
{
    return !l->inside && l->clear > radius && (h->depth || l->clear - radius >= h->best - by);
}

static void keep_best(hunt *h, double d, const double p[3])
{
    if (h->depth ? d <= h->best : d >= h->best) return;
    h->best = d;
    h->found = true;
    vec_copy(p, h->at);
}

/* `from`: a point where the depth is at most d, or the distance at least. */
static void try_point(hunt *h, const double p[3], const double from[3], double d)
{
    double way = vec_distance(p, from);
    if (h->depth ? d + way <= h->best : d - way >= h->best) return;
    bool inside = solid_grid_inside(h->other->grid, p);
    if (h->depth && inside)
        keep_best(h, distance_tree_between(h->other->tree, p, h->best, HUGE_VAL, NULL), p);
    else if (!h->depth)
        keep_best(h, inside ? 0 : distance_tree_between(h->other->tree, p, 0, h->best, NULL), p);
}

/* Tries the middle of a piece; false if no point within this radius of it can better the best. d: at most so deep, or
 * the distance. */
static bool try_middle(hunt *h, const double p[3], const look *l, double radius, double *d)
{
    const double tolerance = h->other->tolerance_mm, spare = radius > tolerance ? radius - tolerance : 0;
    const distance_tree *tree = h->other->tree;
    if (!h->depth) {
        *d = l->inside ? 0 : distance_tree_between(tree, p, 0, h->best + spare, NULL);
        keep_best(h, *d, p);
        return *d - radius < h->best - tolerance;
    }
    if (!l->inside) {
        double reach = radius - h->best - tolerance;
        *d = 0;
        return l->clear < reach && distance_tree_within(tree, p, reach);
    }
    if (h->best > 0 && h->best < near_mm)
        *d = fmax(h->best, distance_tree_between(tree, p, h->best, HUGE_VAL, NULL));
    else
        *d = distance_tree_between(tree, p, h->best - spare, HUGE_VAL, NULL);
    keep_best(h, *d, p);
    return *d + radius > h->best + tolerance;
}

static void split(hunt *h, double x[3][3], int level)
{
    double middle[3], radius = 0, d = 0;
    for (int c = 0; c < 3; c++) middle[c] = (x[0][c] + x[1][c] + x[2][c]) / 3;
    for (int k = 0; k < 3; k++) radius = fmax(radius, vec_distance(middle, x[k]));
    look l = look_at(h, middle);
    if (hopeless(h, &l, radius, h->other->tolerance_mm)) return;
    if (h->depth && !l.inside && radius <= fmax(settled_mm, h->best)) { /* settled without distances */
        for (int k = 0; k < 3 && radius > h->best; k++) try_point(h, x[k], middle, 0);
        return;
    }
    if (!try_middle(h, middle, &l, radius, &d)) return;
    for (int k = 0; k < 3 && level == 0; k++) try_point(h, x[k], middle, d);
    double finest = h->depth ? small_mm : fmax(finest_distance_mm, finest_share * d);
    if (radius <= finest || level == SPLIT_DEPTH) return;
    double m[3][3]; /* middles of the edges */
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) m[k][c] = (x[k][c] + x[(k + 1) % 3][c]) / 2;
        try_point(h, m[k], middle, d);
    }
    const double *part[4][3] = {{m[0], m[1], m[2]}, {x[0], m[0], m[2]}, {x[1], m[1], m[0]}, {x[2], m[2], m[1]}};
    for (int i = 0; i < 4 && (h->depth || h->best > 0); i++) {
        double y[3][3];
        for (int k = 0; k < 3; k++) vec_copy(part[i][k], y[k]);
        split(h, y, level + 1);
    }
}

/* ---- patches, the most promising first, so that the rest need no look ---- */

typedef struct candidate {
    double centre[3], radius;
    look l;
    double bound; /* the signed distance that it may reach; of a depth it is negative */
    int32_t patch;
} candidate;

typedef struct candidates {
    candidate *list;
    int32_t count, room;
} candidates;

static int by_bound(const void *a, const void *b)
{
    const candidate *x = a, *y = b;
    if (x->bound != y->bound) return x->bound < y->bound ? -1 : 1;
    return x->patch < y->patch ? -1 : 1;
}

static candidates find_candidates(const hunt *h, const patches *p, unsigned kinds)
{
    candidates all = {0};
    double tolerance = h->other->tolerance_mm;
    for (const patch *g = p->group; g < p->group + p->group_count; g++) {
        double centre[3];
        if (!(g->kinds & kinds)) continue;
        rigid_apply(&h->to_other, g->centre, centre);
        look far = look_at(h, centre);
        if (hopeless(h, &far, g->radius, 0)) continue;
        for (int32_t i = g->first; i < g->first + g->count; i++) {
            candidate c = {.patch = i, .radius = p->patch[i].radius};
            if (!(p->patch[i].kinds & kinds)) continue;
            rigid_apply(&h->to_other, p->patch[i].centre, c.centre);
            c.l = look_at(h, c.centre);
            if (hopeless(h, &c.l, c.radius, tolerance)) continue;
            if (all.count == all.room) {
                all.room = 2 * all.room + 64;
                all.list = GROW_ARRAY(candidate, all.list, all.room);
            }
            all.list[all.count++] = c;
        }
    }
    return all;
}

/* A depth or distance that is certainly reached, by the one that looks best. */
static double promise(const hunt *h, const candidates *all)
{
    const candidate *first = NULL;
    for (const candidate *c = all->list; c < all->list + all->count; c++) {
        if (h->depth && !c->l.inside) continue;
        bool better = first && (h->depth ? c->l.clear - c->radius > first->l.clear - first->radius
                                         : c->l.clear - c->radius < first->l.clear - first->radius);
        if (!first || better) first = c;
    }
    if (!first) return h->best;
    double d = distance_tree_to(h->other->tree, first->centre, NULL);
    return h->depth ? fmax(h->best, d - first->radius) : fmin(h->best, d + first->radius);
}

/* Signed distance of its centre (negative inside), exact where the patch can better what is promised, which is
 * then raised. */
static double least_signed(const hunt *h, const candidate *c, double *promised)
{
    const distance_tree *tree = h->other->tree;
    double low = h->depth ? *promised + h->other->tolerance_mm - c->radius : 0, high = *promised + c->radius, d;
    if (c->l.inside) {
        d = distance_tree_between(tree, c->centre, low, HUGE_VAL, NULL);
        if (h->depth) *promised = fmax(*promised, d - c->radius);
        return -d;
    }
    if (h->depth || c->l.clear >= high) return c->l.clear; /* most patches, and little can be there */
    d = distance_tree_between(tree, c->centre, 0, high, NULL);
    *promised = fmin(*promised, d + c->radius);
    return d;
}

static void search_patch(hunt *h, const clash_body *own, const candidate *c, unsigned kinds)
{
    const patch *p = &own->patches.patch[c->patch];
    double x[3][3];
    for (int32_t k = p->first; k < p->first + p->count && (h->depth || h->best > 0); k++) {
        int32_t t = own->patches.order[k];
        double reach = 0;
        if (own->kind && !(own->kind[t] & kinds)) continue;
        for (int v = 0; v < 3; v++) {
            rigid_apply(&h->to_other, own->s->xyz + 3 * (size_t)own->s->tri[3 * (size_t)t + (size_t)v], x[v]);
            reach = fmax(reach, vec_distance(x[v], c->centre));
        }
        double bound = c->bound + c->radius - reach; /* tighter than the patch's */
        if (h->depth ? -bound > h->best : bound < h->best) split(h, x, 0);
    }
}

static void search(hunt *h, const clash_body *own, unsigned kinds)
{
    double tolerance = h->other->tolerance_mm;
    candidates all = find_candidates(h, &own->patches, kinds);
    if (!all.count) return;
    double promised = promise(h, &all);
    int32_t count = 0; /* of those that may better what is promised */
    for (candidate *c = all.list; c < all.list + all.count; c++) {
        c->bound = least_signed(h, c, &promised) - c->radius;
        if (h->depth ? -c->bound > promised + tolerance : c->bound < promised) all.list[count++] = *c;
    }
    qsort(all.list, (size_t)count, sizeof *all.list, by_bound);
    for (const candidate *c = all.list; c < all.list + count; c++) {
        if (h->depth ? -c->bound <= h->best + tolerance : c->bound >= h->best - tolerance) break;
        search_patch(h, own, c, kinds);
    }
    free(all.list);
}

clash_spot clash_depth(const clash_body *still, const clash_body *moved, const rigid *rel, unsigned kinds)
{
    hunt in = {.other = still, .to_other = *rel, .depth = true};
    search(&in, moved, kinds);
    hunt back = {.other = moved, .to_other = rigid_inverse(rel), .depth = true, .best = in.best};
    search(&back, still, kinds);
    clash_spot spot = {.mm = fmax(in.best, back.best), .found = in.found || back.found};
    if (back.found)
        rigid_apply(rel, back.at, spot.place);
    else
        vec_copy(in.at, spot.place);
    return spot;
}

clash_spot clash_distance(const clash_body *still, const clash_body *moved, const rigid *rel, unsigned kinds,
                          double reach_mm)
{
    hunt to = {.other = still, .to_other = *rel, .best = reach_mm};
    search(&to, moved, kinds);
    hunt back = {.other = moved, .to_other = rigid_inverse(rel), .best = to.best};
    search(&back, still, kinds);
    clash_spot spot = {.mm = back.best, .found = to.found || back.found};
    if (back.found)
        rigid_apply(rel, back.at, spot.place);
    else
        vec_copy(to.at, spot.place);
    return spot;
}
