#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

enum { WAYS = 4, LEAF = 4, BRANCH = -1 }; /* children of a node, triangles of a leaf at most */

/* Boxes are in single precision, about the surface's middle, and so much larger that rounding never makes one too far;
 * `doubt` covers what is left for points far away. */
static const double margin = 1e-6, doubt = 1e-5;

typedef struct tree_node {
    float low[3][WAYS], high[3][WAYS];
    int32_t first[WAYS], count[WAYS]; /* triangles; count BRANCH: the node `first` */
} tree_node;

typedef struct tree_triangle {
    double a[3], ab[3], ac[3];
    int32_t number;
} tree_triangle;

struct distance_tree {
    double middle[3], size;
    tree_node *node;
    tree_triangle *triangle;
    int32_t node_count;
};

/* ---- making ---- */

typedef struct making {
    const surface *s;
    distance_tree *t;
    int32_t *order;
    double *middle; /* [3*triangle_count] */
} making;

typedef struct range {
    int32_t first, count;
} range;

static void set_box(making *m, tree_node *n, int way, range r)
{
    for (int c = 0; c < 3; c++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int32_t i = r.first; i < r.first + r.count; i++)
            for (int k = 0; k < 3; k++) {
                double x = m->s->xyz[3 * (size_t)m->s->tri[3 * (size_t)m->order[i] + (size_t)k] + (size_t)c];
                low = x < low ? x : low;
                high = x > high ? x : high;
            }
        n->low[c][way] = (float)(low - m->t->middle[c] - margin * m->t->size);
        n->high[c][way] = (float)(high - m->t->middle[c] + margin * m->t->size);
    }
}

/* Puts those whose middles lie below the middle of the widest side first: both parts. */
static void halve(making *m, range r, range part[2])
{
    int widest = 0;
    double at = 0, width = -1;
    for (int c = 0; c < 3; c++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int32_t i = r.first; i < r.first + r.count; i++) {
            double x = m->middle[3 * (size_t)m->order[i] + (size_t)c];
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        if (!(high - low > width)) continue;
        width = high - low;
        at = (low + high) / 2;
        widest = c;
    }
    int32_t below = 0;
    for (int32_t i = r.first; i < r.first + r.count; i++) {
        int32_t t = m->order[i];
        if (m->middle[3 * (size_t)t + (size_t)widest] >= at) continue;
        m->order[i] = m->order[r.first + below];
        m->order[r.first + below++] = t;
    }
    if (!below || below == r.count) below = r.count / 2; /* all at one place */
    part[0] = (range){r.first, below};
    part[1] = (range){r.first + below, r.count - below};
}

/* The node of these triangles; returns its number. */
static int32_t make_node(making *m, range r)
{
    int32_t node = m->t->node_count++;
    range half[2], way[WAYS] = {r};
    if (r.count > LEAF) {
        halve(m, r, half);
        halve(m, half[0], way);
        halve(m, half[1], way + 2);
    }
    for (int k = 0; k < WAYS; k++) {
        bool leaf = way[k].count <= LEAF;
        int32_t first = leaf ? way[k].first : make_node(m, way[k]);
        set_box(m, &m->t->node[node], k, way[k]);
        m->t->node[node].first[k] = first;
        m->t->node[node].count[k] = leaf ? way[k].count : BRANCH;
    }
    return node;
}

static void find_size(distance_tree *t, const surface *s)
{
    double low[3], high[3];
    surface_bounds(s, low, high);
    for (int c = 0; c < 3; c++) t->middle[c] = (low[c] + high[c]) / 2;
    t->size = vec_distance(low, high);
}

distance_tree *distance_tree_make(const surface *s)
{
    int32_t count = s->triangle_count;
    distance_tree *t = NEW_ARRAY(distance_tree, 1);
    making m = {.s = s, .t = t, .order = NEW_ARRAY(int32_t, count), .middle = NEW_ARRAY(double, 3 * (size_t)count)};
    t->node = NEW_ARRAY(tree_node, count + 1); /* enough: of each at least two children hold some */
    t->triangle = NEW_ARRAY(tree_triangle, count);
    if (count) find_size(t, s);
    for (int32_t i = 0; i < count; i++) {
        m.order[i] = i;
        for (int k = 0; k < 3; k++)
            vec_axpy(m.middle + 3 * (size_t)i, 1 / 3.0, s->xyz + 3 * (size_t)s->tri[3 * (size_t)i + (size_t)k],
                     m.middle + 3 * (size_t)i);
    }
    (void)make_node(&m, (range){0, count});
    t->node = GROW_ARRAY(tree_node, t->node, t->node_count);
    for (int32_t i = 0; i < count; i++) {
        const int32_t *v = s->tri + 3 * (size_t)m.order[i];
        tree_triangle *x = &t->triangle[i];
        x->number = m.order[i];
        vec_copy(s->xyz + 3 * (size_t)v[0], x->a);
        vec_sub(s->xyz + 3 * (size_t)v[1], x->a, x->ab);
        vec_sub(s->xyz + 3 * (size_t)v[2], x->a, x->ac);
    }
    free(m.order);
    free(m.middle);
    return t;
}

void distance_tree_free(distance_tree **t)
{
    if (!*t) return;
    free((*t)->node);
    free((*t)->triangle);
    free(*t);
    *t = NULL;
}

/* ---- asking ---- */

typedef struct question {
    const distance_tree *t;
    double p[3], low2, best2; /* squares; best2: of what is found so far, at first of what matters */
    bool settled;             /* not above low */
    float at_tree[3];         /* p about the tree's middle */
    const tree_triangle *found;
    double at[3];
} question;

/* Nearest point of the triangle (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5). */
static void try_triangle(question *q, const tree_triangle *t)
{
    double ap[3], near[3], d[3], v, w;
    vec_sub(q->p, t->a, ap);
    double d1 = vec_dot(t->ab, ap), d2 = vec_dot(t->ac, ap), aa = vec_dot(t->ab, t->ab), bb = vec_dot(t->ac, t->ac),
           m = vec_dot(t->ab, t->ac), d3 = d1 - aa, d4 = d2 - m, d5 = d1 - m, d6 = d2 - bb, vc = d1 * d4 - d3 * d2,
           vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (d1 <= 0 && d2 <= 0)
        v = w = 0;
    else if (d3 >= 0 && d4 <= d3)
        v = 1, w = 0;
    else if (d6 >= 0 && d5 <= d6)
        v = 0, w = 1;
    else if (vc <= 0 && d1 >= 0 && d3 <= 0)
        v = d1 / (d1 - d3), w = 0;
    else if (vb <= 0 && d2 >= 0 && d6 <= 0)
        v = 0, w = d2 / (d2 - d6);
    else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        w = (d4 - d3) / (d4 - d3 + d5 - d6), v = 1 - w;
    else
        v = vb / (va + vb + vc), w = vc / (va + vb + vc);
    for (int c = 0; c < 3; c++) near[c] = t->a[c] + v * t->ab[c] + w * t->ac[c];
    vec_sub(q->p, near, d);
    double square = vec_dot(d, d);
    if (!(square < q->best2)) return;
    q->best2 = square;
    q->found = t;
    q->settled = square <= q->low2;
    vec_copy(near, q->at);
}

static void squares_to_boxes(const tree_node *n, const float p[3], float square[WAYS])
{
#pragma omp simd
    for (int k = 0; k < WAYS; k++) {
        float sum = 0;
        for (int c = 0; c < 3; c++) {
            float near = p[c] > n->low[c][k] ? p[c] : n->low[c][k];
            near = near < n->high[c][k] ? near : n->high[c][k];
            sum += (p[c] - near) * (p[c] - near);
        }
        square[k] = sum;
    }
}

/* The nearer children first. */
static void visit(question *q, const tree_node *n)
{
    float square[WAYS];
    squares_to_boxes(n, q->at_tree, square);
    for (int done = 0; done < WAYS && !q->settled; done++) {
        int k = 0;
        for (int i = 1; i < WAYS; i++) k = square[i] < square[k] ? i : k;
        if (!((double)square[k] < q->best2 * (1 + doubt))) return;
        square[k] = HUGE_VALF;
        if (n->count[k] == BRANCH) visit(q, &q->t->node[n->first[k]]);
        for (int32_t i = n->first[k]; i < n->first[k] + n->count[k] && !q->settled; i++)
            try_triangle(q, &q->t->triangle[i]);
    }
}

double distance_tree_between(const distance_tree *t, const double p[3], double low, double high, distance_hit *hit)
{
    question q = {.t = t, .low2 = low > 0 ? low * low : -1, .best2 = high * high};
    vec_copy(p, q.p);
    for (int c = 0; c < 3; c++) q.at_tree[c] = (float)(p[c] - t->middle[c]);
    if (high > 0) visit(&q, t->node);
    if (!q.found) return high;
    if (hit) {
        vec_copy(q.at, hit->at);
        hit->triangle = q.found->number;
    }
    return sqrt(q.best2);
}

double distance_tree_to(const distance_tree *t, const double p[3], distance_hit *hit)
{
    return distance_tree_between(t, p, 0, HUGE_VAL, hit);
}

bool distance_tree_within(const distance_tree *t, const double p[3], double reach_mm)
{
    distance_hit any = {.triangle = -1};
    (void)distance_tree_between(t, p, reach_mm, reach_mm, &any);
    return any.triangle >= 0;
}
