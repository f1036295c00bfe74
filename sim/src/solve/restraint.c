#include "sim/src/solve/restraint.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "sim/src/elastic/svd3.h"
#include <stdlib.h>
#include <string.h>

static int32_t root_of(int32_t *parent, int32_t v)
{
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

/* One row per held direction n at point p: n . (translation + rotation x p) = 0. */
static void add_row(double gram[36], const double n[3], const double p[3])
{
    double row[6];
    vec_copy(n, row);
    vec_cross(p, n, row + 3);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) gram[6 * i + j] += row[i] * row[j];
}

bool restraint_check(const tetmesh *m, const attach_map *a, err *e)
{
    int32_t n = m->vertex_count, *parent = NEW_ARRAY(int32_t, n), *size = NEW_ARRAY(int32_t, n);
    uint8_t *used = NEW_ARRAY(uint8_t, n);
    double *centre = NEW_ARRAY(double, 3 * (size_t)n), *gram = NULL, *reach = NEW_ARRAY(double, n);
    int32_t *part = NEW_ARRAY(int32_t, n), parts = 0;
    bool ok = false;
    for (int32_t v = 0; v < n; v++) parent[v] = v;
    for (int32_t t = 0; t < m->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            int32_t v = m->tet[4 * (size_t)t + k], r = root_of(parent, v);
            int32_t s = root_of(parent, m->tet[4 * (size_t)t]);
            used[v] = 1;
            if (r < s)
                parent[s] = r;
            else
                parent[r] = s;
        }
    int32_t loose = 0, first = -1;
    for (int32_t v = 0; v < n; v++)
        if (!used[v]) {
            if (first < 0) first = v;
            loose++;
        }
    if (loose > 0) {
        err_set(e, ERR_GEOMETRY, "%d mesh nodes are in no tet, the first is node %d", loose, first);
        goto done;
    }
    for (int32_t v = 0; v < n; v++)
        if (parent[v] == v) part[v] = parts++;
    gram = NEW_ARRAY(double, 36 * (size_t)parts);
    for (int32_t v = 0; v < n; v++) {
        int32_t p = part[v] = part[root_of(parent, v)];
        size[p]++;
        vec_add(centre + 3 * (size_t)p, m->xyz + 3 * (size_t)v, centre + 3 * (size_t)p);
    }
    for (int32_t p = 0; p < parts; p++) vec_scale(centre + 3 * (size_t)p, 1.0 / size[p], centre + 3 * (size_t)p);
    for (int32_t v = 0; v < n; v++)
        reach[part[v]] = fmax(reach[part[v]], vec_distance(m->xyz + 3 * (size_t)v, centre + 3 * (size_t)part[v]));
    for (int32_t v = 0; v < n; v++) {
        static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        double p[3];
        vec_sub(m->xyz + 3 * (size_t)v, centre + 3 * (size_t)part[v], p);
        vec_scale(p, 1 / reach[part[v]], p);
        if (a->kind[v] == NODE_TIED)
            for (int c = 0; c < 3; c++) add_row(gram + 36 * (size_t)part[v], axis[c], p);
        if (a->kind[v] == NODE_SLIDING) add_row(gram + 36 * (size_t)part[v], a->normal + 3 * (size_t)v, p);
    }
    for (int32_t p = 0; p < parts; p++) {
        double value[6], Q[36];
        symmetric_eigen(6, gram + 36 * (size_t)p, value, Q);
        int free_moves = 0;
        for (int k = 0; k < 6; k++) free_moves += !(value[k] > 1e-8); /* rows are of order one: 1e-4 in length */
        if (free_moves == 0) continue;
        const double *c = centre + 3 * (size_t)p;
        err_set(e, ERR_GEOMETRY,
                "a part of the tissue is not held by bone: %d of its 6 rigid motions are free (%d of %d "
                "nodes, about "
                "%.1f %.1f %.1f mm, radius %.1f mm, %d parts in all)",
                free_moves, size[p], n, c[0], c[1], c[2], reach[p], parts);
        goto done;
    }
    ok = true;
done:
    free(parent);
    free(size);
    free(used);
    free(centre);
    free(gram);
    free(reach);
    free(part);
    return ok;
}
