#include "geometry/clash.h"
#include "geometry/mem.h"
#include "geometry/src/bone_cells.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double patch_mm = 2; /* triangles are grouped by where they lie */
enum { SPLIT_DEPTH = 12 };

typedef struct patch { /* neighbouring triangles: order[first .. first + count) */
    double centre[3], radius;
    int32_t first, count;
    unsigned kinds;
} patch;

struct clash_body {
    const surface *s;
    uint8_t *kind; /* NULL: all 1 */
    clash_params params;
    solid_grid *grid;
    distance_tree *tree;
    int32_t *order;
    patch *patches;
    int32_t patch_count;
    bone_cells cells;
};

clash_params clash_params_default(void)
{
    return (clash_params){.cell_mm = 0.7, .step_mm = 0.7, .tolerance_mm = 0.02};
}

/* ---- patches ---- */

typedef struct sort_key {
    int32_t box[3], triangle;
} sort_key;

static int by_box(const void *a, const void *b)
{
    const sort_key *x = a, *y = b;
    for (int c = 2; c >= 0; c--)
        if (x->box[c] != y->box[c]) return x->box[c] < y->box[c] ? -1 : 1;
    return x->triangle < y->triangle ? -1 : 1;
}

static const double *corner(const surface *s, int32_t t, int k)
{
    return s->xyz + 3 * (size_t)s->tri[3 * (size_t)t + (size_t)k];
}

static void close_patch(clash_body *b, int32_t first, int32_t end)
{
    patch p = {.first = first, .count = end - first};
    bool outside = false;
    for (int32_t i = first; i < end; i++)
        for (int k = 0; k < 3; k++)
            vec_axpy(p.centre, 1 / (3.0 * p.count), corner(b->s, b->order[i], k), p.centre);
    for (int32_t i = first; i < end; i++) {
        p.kinds |= b->kind ? b->kind[b->order[i]] : 1;
        for (int k = 0; k < 3; k++)
            p.radius = fmax(p.radius, vec_distance(p.centre, corner(b->s, b->order[i], k)));
    }
    for (int c = 0; c < 3 && b->params.box; c++)
        outside |= p.centre[c] + p.radius < b->params.box[c] || p.centre[c] - p.radius > b->params.box[3 + c];
    if (outside) return;
    b->patches = GROW_ARRAY(patch, b->patches, b->patch_count + 1);
    b->patches[b->patch_count++] = p;
}

static void make_patches(clash_body *b)
{
    int32_t count = b->s->triangle_count, first = 0;
    sort_key *key = NEW_ARRAY(sort_key, count);
    for (int32_t t = 0; t < count; t++) {
        key[t].triangle = t;
        for (int c = 0; c < 3; c++)
            key[t].box[c] = (int32_t)floor(
                (corner(b->s, t, 0)[c] + corner(b->s, t, 1)[c] + corner(b->s, t, 2)[c]) / (3 * patch_mm));
    }
    qsort(key, (size_t)count, sizeof *key, by_box);
    b->order = NEW_ARRAY(int32_t, count);
    for (int32_t i = 0; i < count; i++) b->order[i] = key[i].triangle;
    for (int32_t i = 1; i <= count; i++)
        if (i == count || memcmp(key[i].box, key[first].box, sizeof key[i].box)) {
            close_patch(b, first, i);
            first = i;
        }
    free(key);
}

bool clash_body_make(const surface *s, const uint8_t *kind, const clash_params *p, clash_body **out, err *e)
{
    clash_body *b = NEW_ARRAY(clash_body, 1);
    b->s = s;
    b->params = *p;
    b->kind = kind ? COPY_ARRAY(uint8_t, kind, s->triangle_count) : NULL;
    if (!solid_grid_make(s, p->step_mm, p->box, &b->grid, e)) {
        clash_body_free(&b);
        return false;
    }
    b->tree = distance_tree_make(s);
    make_patches(b);
    if (p->cell_mm > 0) b->cells = bone_cells_make(s, b->grid, p->cell_mm);
    b->params.box = NULL; /* borrowed for the making only */
    *out = b;
    return true;
}

void clash_body_free(clash_body **b)
{
    if (!*b) return;
    distance_tree_free(&(*b)->tree);
    solid_grid_free(&(*b)->grid);
    bone_cells_free(&(*b)->cells);
    free((*b)->kind);
    free((*b)->order);
    free((*b)->patches);
    free(*b);
    *b = NULL;
}

const solid_grid *clash_body_grid(const clash_body *b)
{
    return b->grid;
}

const distance_tree *clash_body_tree(const clash_body *b)
{
    return b->tree;
}

double clash_volume(const clash_body *still, const clash_body *moved, const rigid *rel)
{
    return bone_cells_inside(&moved->cells, still->grid, rel);
}

/* ---- depth and distance: branch and bound, because neither changes faster than the point moves. Where both
 * surfaces run side by side nothing is bounded away, so that the search ends at small triangles: the extremes
 * of flat facets lie at corners, which are tried, and between tried points of a curved one the error is of
 * second order. ---- */

static const double small_mm = 0.7, settled_mm = 1, near_mm = 1.5, finest_distance_mm = 0.05,
                    finest_share = 0.3;

typedef struct hunt {
    const clash_body *other;
    rigid to_other;
    bool depth;   /* the largest depth, else the least distance */
    double best;  /* so far: depth, or distance */
    double at[3]; /* in the frame of `other` */
    bool found;
} hunt;

/* No point within this radius can better the best, from what the grid alone knows. */
static bool hopeless(const hunt *h, const double p[3], double radius)
{
    double clear = solid_grid_clear(h->other->grid, p);
    if (clear <= radius || solid_grid_inside(h->other->grid, p)) return false;
    return h->depth || clear - radius >= h->best - h->other->params.tolerance_mm;
}

static void keep_best(hunt *h, double d, const double p[3])
{
    if (h->depth ? d <= h->best : d >= h->best) return;
    h->best = d;
    h->found = true;
    vec_copy(p, h->at);
}

static bool is_inside(const hunt *h, const double p[3])
{
    return solid_grid_inside(h->other->grid, p);
}

static void try_point(hunt *h, const double p[3])
{
    bool inside = is_inside(h, p);
    if (h->depth && inside)
        keep_best(h, distance_tree_between(h->other->tree, p, h->best, HUGE_VAL, NULL), p);
    else if (!h->depth)
        keep_best(h, inside ? 0 : distance_tree_between(h->other->tree, p, 0, h->best, NULL), p);
}

/* Tries the middle of a piece; false if no point within this radius of it can better the best. d: its
 * distance, where it is the least distance that is looked for. */
static bool try_middle(hunt *h, const double p[3], double radius, double *d)
{
    const double tolerance = h->other->params.tolerance_mm;
    const distance_tree *tree = h->other->tree;
    bool inside = is_inside(h, p);
    if (!h->depth) {
        *d = inside ? 0 : distance_tree_between(tree, p, 0, h->best + fmax(radius - tolerance, 0), NULL);
        keep_best(h, *d, p);
        return *d - radius < h->best - tolerance;
    }
    if (!inside) return distance_tree_within(tree, p, radius - h->best - tolerance);
    if (h->best > 0 && h->best < near_mm)
        *d = fmax(h->best, distance_tree_between(tree, p, h->best, HUGE_VAL, NULL));
    else
        *d = distance_tree_between(tree, p, h->best - fmax(radius - tolerance, 0), HUGE_VAL, NULL);
    keep_best(h, *d, p);
    return *d + radius > h->best + tolerance;
}

static void split(hunt *h, double x[3][3], int level)
{
    double middle[3], radius = 0, d = 0;
    for (int c = 0; c < 3; c++) middle[c] = (x[0][c] + x[1][c] + x[2][c]) / 3;
    for (int k = 0; k < 3; k++) radius = fmax(radius, vec_distance(middle, x[k]));
    if (hopeless(h, middle, radius)) return;
    if (h->depth && radius <= fmax(settled_mm, h->best) &&
        !is_inside(h, middle)) { /* settled without distances */
        for (int k = 0; k < 3 && radius > h->best; k++) try_point(h, x[k]);
        return;
    }
    if (!try_middle(h, middle, radius, &d)) return;
    for (int k = 0; k < 3 && level == 0; k++) try_point(h, x[k]);
    double finest = h->depth ? small_mm : fmax(finest_distance_mm, finest_share * d);
    if (radius <= finest || level == SPLIT_DEPTH) return;
    double m[3][3]; /* middles of the edges */
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) m[k][c] = (x[k][c] + x[(k + 1) % 3][c]) / 2;
        try_point(h, m[k]);
    }
    const double *part[4][3] = {
        {m[0], m[1], m[2]}, {x[0], m[0], m[2]}, {x[1], m[1], m[0]}, {x[2], m[2], m[1]}};
    for (int i = 0; i < 4 && (h->depth || h->best > 0); i++) {
        double y[3][3];
        for (int k = 0; k < 3; k++) vec_copy(part[i][k], y[k]);
        split(h, y, level + 1);
    }
}

typedef struct candidate { /* a patch, and the best that it can hold */
    double bound;
    int32_t patch;
} candidate;

static int by_bound(const void *a, const void *b)
{
    const candidate *x = a, *y = b;
    if (x->bound != y->bound) return x->bound < y->bound ? -1 : 1;
    return x->patch < y->patch ? -1 : 1;
}

static void search_patch(hunt *h, const clash_body *own, const patch *p, unsigned kinds)
{
    double x[3][3];
    for (int32_t k = p->first; k < p->first + p->count && (h->depth || h->best > 0); k++) {
        int32_t t = own->order[k];
        if (own->kind && !(own->kind[t] & kinds)) continue;
        for (int v = 0; v < 3; v++) rigid_apply(&h->to_other, corner(own->s, t, v), x[v]);
        split(h, x, 0);
    }
}

/* Signed distance of a patch's centre (negative inside), exact where the patch can better the best. */
static double least_signed(const hunt *h, const double p[3], double radius)
{
    const distance_tree *tree = h->other->tree;
    double tolerance = h->other->params.tolerance_mm;
    if (is_inside(h, p))
        return -distance_tree_between(tree, p, h->depth ? h->best + tolerance - radius : 0, HUGE_VAL, NULL);
    if (h->depth) return solid_grid_clear(h->other->grid, p); /* most patches, and little can be there */
    return distance_tree_between(tree, p, 0, h->best + radius, NULL);
}

/* The most promising patches first, so that the rest need no look. */
static void search(hunt *h, const clash_body *own, unsigned kinds)
{
    candidate *list = NEW_ARRAY(candidate, own->patch_count);
    int32_t count = 0;
    double tolerance = h->other->params.tolerance_mm;
    for (int32_t i = 0; i < own->patch_count; i++) {
        const patch *p = &own->patches[i];
        double centre[3];
        if (!(p->kinds & kinds)) continue;
        rigid_apply(&h->to_other, p->centre, centre);
        if (hopeless(h, centre, p->radius)) continue;
        list[count++] = (candidate){least_signed(h, centre, p->radius) - p->radius, i};
    }
    qsort(list, (size_t)count, sizeof *list, by_bound);
    for (int32_t i = 0; i < count; i++) {
        double can = h->depth ? -list[i].bound : list[i].bound;
        if (h->depth ? can <= h->best + tolerance : can >= h->best - tolerance) break;
        search_patch(h, own, &own->patches[list[i].patch], kinds);
    }
    free(list);
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
