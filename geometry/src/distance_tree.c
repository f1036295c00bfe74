#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>

enum { LEAF = 4, BRANCH = -1 }; /* triangles of a leaf at most */

typedef struct tree_node {
    float low[3], high[3]; /* outwards of the true box */
    int32_t first, count;  /* triangles; count BRANCH: the two nodes first and first + 1 */
} tree_node;

typedef struct tree_triangle {
    double a[3], ab[3], ac[3];
    int32_t number;
} tree_triangle;

struct distance_tree {
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

static void close_node(making *m, tree_node *n, int32_t first, int32_t count)
{
    for (int c = 0; c < 3; c++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int32_t i = first; i < first + count; i++)
            for (int k = 0; k < 3; k++) {
                double x = m->s->xyz[3 * (size_t)m->s->tri[3 * (size_t)m->order[i] + (size_t)k] + (size_t)c];
                low = fmin(low, x);
                high = fmax(high, x);
            }
        n->low[c] = nextafterf((float)low, -HUGE_VALF);
        n->high[c] = nextafterf((float)high, HUGE_VALF);
    }
}

/* Puts those whose middles lie below the middle of the widest side first, and counts them. */
static int32_t halve(making *m, int32_t first, int32_t count)
{
    int widest = 0;
    double at = 0, width = -1;
    for (int c = 0; c < 3; c++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int32_t i = first; i < first + count; i++) {
            low = fmin(low, m->middle[3 * (size_t)m->order[i] + (size_t)c]);
            high = fmax(high, m->middle[3 * (size_t)m->order[i] + (size_t)c]);
        }
        if (!(high - low > width)) continue;
        width = high - low;
        at = (low + high) / 2;
        widest = c;
    }
    int32_t below = 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t t = m->order[first + i];
        if (m->middle[3 * (size_t)t + (size_t)widest] >= at) continue;
        m->order[first + i] = m->order[first + below];
        m->order[first + below++] = t;
    }
    return below && below < count ? below : count / 2;
}

static void make_node(making *m, int32_t node, int32_t first, int32_t count)
{
    distance_tree *t = m->t;
    close_node(m, &t->node[node], first, count);
    if (count <= LEAF) {
        t->node[node].first = first;
        t->node[node].count = count;
        return;
    }
    int32_t below = halve(m, first, count), child = t->node_count;
    t->node[node].first = child;
    t->node[node].count = BRANCH;
    t->node_count += 2;
    make_node(m, child, first, below);
    make_node(m, child + 1, first + below, count - below);
}

distance_tree *distance_tree_make(const surface *s)
{
    int32_t count = s->triangle_count;
    distance_tree *t = NEW_ARRAY(distance_tree, 1);
    making m = {
        .s = s, .t = t, .order = NEW_ARRAY(int32_t, count), .middle = NEW_ARRAY(double, 3 * (size_t)count)};
    t->node = NEW_ARRAY(tree_node, 2 * (size_t)count + 1);
    t->triangle = NEW_ARRAY(tree_triangle, count);
    t->node_count = 1;
    for (int32_t i = 0; i < count; i++) {
        m.order[i] = i;
        for (int k = 0; k < 3; k++)
            vec_axpy(m.middle + 3 * (size_t)i, 1 / 3.0,
                     s->xyz + 3 * (size_t)s->tri[3 * (size_t)i + (size_t)k], m.middle + 3 * (size_t)i);
    }
    make_node(&m, 0, 0, count);
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
    const tree_triangle *found;
    double at[3];
} question;

/* Nearest point of the triangle (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5). */
static void try_triangle(question *q, const tree_triangle *t)
{
    double ap[3], near[3], d[3], v, w;
    vec_sub(q->p, t->a, ap);
    double d1 = vec_dot(t->ab, ap), d2 = vec_dot(t->ac, ap), aa = vec_dot(t->ab, t->ab),
           bb = vec_dot(t->ac, t->ac), m = vec_dot(t->ab, t->ac), d3 = d1 - aa, d4 = d2 - m, d5 = d1 - m,
           d6 = d2 - bb, vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
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

static double square_to_box(const tree_node *n, const double p[3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double below = (double)n->low[c] - p[c], above = p[c] - (double)n->high[c], d = below > above ? below : above;
        if (d > 0) sum += d * d;
    }
    return sum;
}

static void visit(question *q, const tree_node *n)
{
    if (n->count != BRANCH) {
        for (int32_t i = n->first; i < n->first + n->count && !q->settled; i++)
            try_triangle(q, &q->t->triangle[i]);
        return;
    }
    const tree_node *child = &q->t->node[n->first];
    double d[2] = {square_to_box(&child[0], q->p), square_to_box(&child[1], q->p)};
    int nearer = d[1] < d[0];
    if (d[nearer] < q->best2) visit(q, &child[nearer]);
    if (d[!nearer] < q->best2 && !q->settled) visit(q, &child[!nearer]);
}

double distance_tree_between(const distance_tree *t, const double p[3], double low, double high,
                             distance_hit *hit)
{
    question q = {.t = t, .low2 = low > 0 ? low * low : -1, .best2 = high * high};
    vec_copy(p, q.p);
    if (high > 0 && square_to_box(t->node, p) < q.best2) visit(&q, t->node);
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
