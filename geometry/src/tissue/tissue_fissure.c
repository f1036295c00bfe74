/* A node on the sheet sees its tets as a fan that the sheet's facets cut into groups; each group beyond the first
 * gets a copy of the node. Nodes on the rim of the sheet have one group and stay whole. */
#include "geometry/src/tissue/tissue_fissure.h"
#include "geometry/mem.h"
#include "geometry/union_find.h"
#include "geometry/vec.h"
#include <stdlib.h>

static const double corner_margin_mm = 1.0; /* the last mm at each mouth corner stays closed */

static bool in_fissure(const tissue_domain *d, const tetmesh *m, int32_t t, int k)
{
    double centre[3] = {0}, local[3];
    for (int a = 0; a < 3; a++)
        vec_axpy(centre, 1.0 / 3, m->xyz + 3 * (size_t)m->tet[4 * (size_t)t + (size_t)tet_face[k][a]], centre);
    head_frame_to_local(&d->frame, centre, local);
    return local[0] > d->lips.x[0] + corner_margin_mm && local[0] < d->lips.x[2] - corner_margin_mm;
}

/* Marks the facets of the sheet that are to be cut: cut[4 t + k]. */
static void mark_sheet(const tissue_domain *d, const tetmesh *m, const int32_t *across, uint8_t *cut)
{
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            int32_t other = across[4 * (size_t)t + (size_t)k];
            cut[4 * (size_t)t + (size_t)k] = other >= 0 && m->region[other] != m->region[t] && in_fissure(d, m, t, k);
        }
}

/* Crumbs: a few tets that the cut would part from everything. They go over to the lip on the other side. */
static void join_crumbs(tetmesh *m, const int32_t *across, const uint8_t *cut)
{
    enum { CRUMB = 40 };
    int32_t *seen = NEW_ARRAY(int32_t, m->tet_count), stack[4 * CRUMB + 4];
    for (int32_t t = 0; t < m->tet_count; t++) {
        int32_t part[CRUMB], size = 0, top = 0;
        bool beside_cut =
            cut[4 * (size_t)t] || cut[4 * (size_t)t + 1] || cut[4 * (size_t)t + 2] || cut[4 * (size_t)t + 3];
        if (!beside_cut || seen[t]) continue;
        stack[top++] = t;
        seen[t] = t + 1;
        while (top && size < CRUMB) {
            int32_t s = part[size++] = stack[--top];
            for (int k = 0; k < 4; k++) {
                int32_t n = across[4 * (size_t)s + (size_t)k];
                if (n < 0 || cut[4 * (size_t)s + (size_t)k] || seen[n] == t + 1) continue;
                seen[n] = t + 1;
                stack[top++] = n;
            }
        }
        if (size == CRUMB || top) continue;
        for (int32_t i = 0; i < size; i++)
            m->region[part[i]] = m->region[part[i]] == REGION_UPPER ? REGION_LOWER : REGION_UPPER;
    }
    free(seen);
}

/* The nodes of the facets to be cut: touched[vertex_count]. */
static void mark_nodes(const tetmesh *m, const uint8_t *cut, uint8_t *touched)
{
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++)
        for (int a = 0; cut[i] && a < 3; a++) touched[m->tet[4 * (i / 4) + (size_t)tet_face[i % 4][a]]] = 1;
}

/* One slot per (tet, corner); slots of the same node in tets that share an uncut face belong together. Returns the
 * forest of groups, [4*tet_count]; the caller frees it. */
static int32_t *group_slots(const tetmesh *m, const int32_t *across, const uint8_t *cut, const uint8_t *touched)
{
    size_t slots = 4 * (size_t)m->tet_count;
    int32_t *parent = NEW_ARRAY(int32_t, slots);
    for (size_t i = 0; i < slots; i++) parent[i] = (int32_t)i;
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            int32_t other = across[4 * (size_t)t + (size_t)k];
            if (other <= t || cut[4 * (size_t)t + (size_t)k]) continue;
            for (int a = 0; a < 3; a++) {
                int32_t i = 4 * t + tet_face[k][a], j = 4 * other, v = m->tet[i];
                if (!touched[v]) continue;
                while (m->tet[j] != v) j++;
                int32_t x = union_root(parent, i), y = union_root(parent, j);
                if (x < y)
                    parent[y] = x;
                else
                    parent[x] = y;
            }
        }
    return parent;
}

typedef struct copies {     /* of the nodes on the sheet */
    int32_t total;          /* nodes, with the copies */
    int32_t *group_node;    /* [4*tet_count] of the root of a group: its node */
    int32_t *upper, *lower; /* [old vertex_count] the first copy in each lip, or -1 */
} copies;

/* The first group of a node keeps it; each other one gets a new node, in the order of the tets. */
static copies number_groups(const tetmesh *m, const uint8_t *touched, int32_t *parent)
{
    int32_t old_count = m->vertex_count;
    size_t slots = 4 * (size_t)m->tet_count;
    copies c = {old_count, NEW_ARRAY(int32_t, slots), NEW_ARRAY(int32_t, old_count), NEW_ARRAY(int32_t, old_count)};
    uint8_t *seen = NEW_ARRAY(uint8_t, old_count);
    for (size_t i = 0; i < slots; i++) c.group_node[i] = -1;
    for (int32_t v = 0; v < old_count; v++) c.upper[v] = c.lower[v] = -1;
    for (size_t i = 0; i < slots; i++) {
        int32_t v = m->tet[i];
        if (!touched[v]) continue;
        int32_t root = union_root(parent, (int32_t)i);
        if (c.group_node[root] >= 0) continue;
        c.group_node[root] = seen[v] ? c.total++ : v;
        seen[v] = 1;
        int32_t *lip = m->region[i / 4] == REGION_UPPER ? c.upper : c.lower;
        if (lip[v] < 0) lip[v] = c.group_node[root];
    }
    free(seen);
    return c;
}

static void split_nodes(tetmesh *m, uint8_t **side, const uint8_t *touched, int32_t *parent, const copies *c)
{
    int32_t old_count = m->vertex_count;
    m->xyz = GROW_ARRAY(double, m->xyz, 3 * (size_t)c->total);
    *side = GROW_ARRAY(uint8_t, *side, c->total);
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++) {
        int32_t v = m->tet[i];
        if (v >= old_count || !touched[v]) continue;
        int32_t copy = c->group_node[union_root(parent, (int32_t)i)];
        vec_copy(m->xyz + 3 * (size_t)v, m->xyz + 3 * (size_t)copy);
        (*side)[copy] = (*side)[v];
        m->tet[i] = copy;
    }
    m->vertex_count = c->total;
}

static lip_pairs pair_copies(const copies *c, int32_t old_count)
{
    lip_pairs out = {.node = NEW_ARRAY(int32_t, 2 * (size_t)old_count)};
    for (int32_t v = 0; v < old_count; v++) {
        if (c->upper[v] < 0 || c->lower[v] < 0 || c->upper[v] == c->lower[v]) continue;
        out.node[2 * out.count] = c->upper[v];
        out.node[2 * out.count++ + 1] = c->lower[v];
    }
    return out;
}

void tissue_open_lips(const tissue_domain *d, tetmesh *m, uint8_t **side, lip_pairs *out)
{
    int32_t *across = tetmesh_neighbours(m), old_count = m->vertex_count;
    uint8_t *cut = NEW_ARRAY(uint8_t, 4 * (size_t)m->tet_count), *touched = NEW_ARRAY(uint8_t, old_count);
    mark_sheet(d, m, across, cut);
    join_crumbs(m, across, cut);
    mark_sheet(d, m, across, cut);
    mark_nodes(m, cut, touched);
    int32_t *parent = group_slots(m, across, cut, touched);
    copies c = number_groups(m, touched, parent);
    split_nodes(m, side, touched, parent, &c);
    *out = pair_copies(&c, old_count);
    free(across);
    free(cut);
    free(touched);
    free(parent);
    free(c.group_node);
    free(c.upper);
    free(c.lower);
}
