/* A node on the sheet sees its tets as a fan that the sheet's facets cut into groups; each group beyond the first
 * gets a copy of the node. Nodes on the rim of the sheet have one group and stay whole. */
#include "geometry/src/tissue/tissue_fissure.h"
#include "geometry/mem.h"
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

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

void tissue_open_lips(const tissue_domain *d, tetmesh *m, uint8_t **side, lip_pairs *out)
{
    int32_t *across = tetmesh_neighbours(m), old_count = m->vertex_count;
    uint8_t *cut = NEW_ARRAY(uint8_t, 4 * (size_t)m->tet_count), *touched = NEW_ARRAY(uint8_t, old_count);
    mark_sheet(d, m, across, cut);
    join_crumbs(m, across, cut);
    mark_sheet(d, m, across, cut);
    for (size_t i = 0; i < 4 * (size_t)m->tet_count; i++)
        for (int a = 0; cut[i] && a < 3; a++) touched[m->tet[4 * (i / 4) + (size_t)tet_face[i % 4][a]]] = 1;
    /* One slot per (tet, corner); slots of the same node in tets that share an uncut face belong together. */
    size_t slots = 4 * (size_t)m->tet_count;
    int32_t *parent = NEW_ARRAY(int32_t, slots), *group_node = NEW_ARRAY(int32_t, slots);
    for (size_t i = 0; i < slots; i++) {
        parent[i] = (int32_t)i;
        group_node[i] = -1;
    }
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            int32_t other = across[4 * (size_t)t + (size_t)k];
            if (other <= t || cut[4 * (size_t)t + (size_t)k]) continue;
            for (int a = 0; a < 3; a++) {
                int32_t i = 4 * t + tet_face[k][a], j = 4 * other, v = m->tet[i];
                if (!touched[v]) continue;
                while (m->tet[j] != v) j++;
                int32_t x = root_of(parent, i), y = root_of(parent, j);
                if (x < y)
                    parent[y] = x;
                else
                    parent[x] = y;
            }
        }
    int32_t *first = NEW_ARRAY(int32_t, old_count), *upper = NEW_ARRAY(int32_t, old_count),
            *lower = NEW_ARRAY(int32_t, old_count), total = old_count;
    for (int32_t v = 0; v < old_count; v++) first[v] = upper[v] = lower[v] = -1;
    for (size_t i = 0; i < slots; i++) {
        int32_t v = m->tet[i];
        if (!touched[v]) continue;
        int32_t root = root_of(parent, (int32_t)i);
        if (group_node[root] < 0) {
            group_node[root] = first[v] < 0 ? v : total++;
            first[v] = v;
            int32_t *slot = m->region[i / 4] == REGION_UPPER ? upper : lower;
            if (slot[v] < 0) slot[v] = group_node[root];
        }
    }
    m->xyz = GROW_ARRAY(double, m->xyz, 3 * (size_t)total);
    *side = GROW_ARRAY(uint8_t, *side, total);
    for (size_t i = 0; i < slots; i++) {
        int32_t v = m->tet[i];
        if (v >= old_count || !touched[v]) continue;
        int32_t copy = group_node[root_of(parent, (int32_t)i)];
        vec_copy(m->xyz + 3 * (size_t)v, m->xyz + 3 * (size_t)copy);
        (*side)[copy] = (*side)[v];
        m->tet[i] = copy;
    }
    m->vertex_count = total;
    *out = (lip_pairs){.node = NEW_ARRAY(int32_t, 2 * (size_t)old_count)};
    for (int32_t v = 0; v < old_count; v++) {
        if (upper[v] < 0 || lower[v] < 0 || upper[v] == lower[v]) continue;
        out->node[2 * out->count] = upper[v];
        out->node[2 * out->count++ + 1] = lower[v];
    }
    free(across);
    free(cut);
    free(touched);
    free(parent);
    free(group_node);
    free(first);
    free(upper);
    free(lower);
}
