#include "geometry/lattice.h"
#include "geometry/distance_tree.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

static const double tet_radius = 0.5590169943749475, face_radius = 0.7071067811865476; /* of edge a, spheres around */
enum { PER_FACE = 4, FACE_GRAIN = 4096, MILLION = 1000000 };

/* Cubes (i, j, k) from 0 to size - 1, cube 0 begins at low. Face f of a cube is the one across axis f on its low side.
 */
typedef struct cubes {
    int64_t low[3], size[3]; /* in cubes */
    double edge;
    double margin;
    const distance_tree *tree;
    uint8_t *kept; /* [3*cubes] bit per tet of each face */
} cubes;

static int64_t cube_count(const cubes *c) { return c->size[0] * c->size[1] * c->size[2]; }

/* Nodes are numbered corners first, then middles: grids one larger than the cubes. */
static int64_t node_number(const cubes *c, bool middle, const int64_t at[3])
{
    int64_t one = (c->size[0] + 1) * (c->size[1] + 1) * (c->size[2] + 1);
    return (middle ? one : 0) + at[0] + (c->size[0] + 1) * (at[1] + (c->size[1] + 1) * at[2]);
}

static void node_place(const cubes *c, int64_t node, double out[3])
{
    int64_t one = (c->size[0] + 1) * (c->size[1] + 1) * (c->size[2] + 1), n = node % one;
    double half = node >= one ? 0.5 : 0;
    for (int a = 0; a < 3; a++) {
        out[a] = c->edge * ((double)(c->low[a] + n % (c->size[a] + 1)) + half);
        n /= c->size[a] + 1;
    }
}

/* Tet `side` of a face: the middles of the cubes on both sides, the corners of one side of the face. */
static void tet_nodes(const cubes *c, int64_t face, int side, int64_t node[4])
{
    static const int8_t corner[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    int64_t cube = face / 3,
            at[3] = {cube % c->size[0], cube / c->size[0] % c->size[1], cube / c->size[0] / c->size[1]};
    int axis = (int)(face % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
    node[1] = node_number(c, true, at);
    for (int k = 0; k < 2; k++) {
        int64_t p[3] = {at[0], at[1], at[2]};
        p[u] += corner[side + k][0];
        p[v] += corner[side + k][1];
        node[2 + k] = node_number(c, false, p);
    }
    at[axis]--;
    node[0] = node_number(c, true, at);
}

static void keep_body(int64_t begin, int64_t end, void *context)
{
    const cubes *c = context;
    for (int64_t face = begin; face < end; face++) {
        int64_t cube = face / 3, node[4];
        int64_t at[3] = {cube % c->size[0], cube / c->size[0] % c->size[1], cube / c->size[0] / c->size[1]};
        double middle[3];
        if (at[face % 3] == 0) continue; /* no cube before it */
        for (int a = 0; a < 3; a++) middle[a] = c->edge * ((double)(c->low[a] + at[a]) + (a == face % 3 ? 0 : 0.5));
        if (!distance_tree_within(c->tree, middle, face_radius * c->edge + c->margin)) continue;
        for (int side = 0; side < PER_FACE; side++) {
            double centre[3] = {0};
            tet_nodes(c, face, side, node);
            for (int k = 0; k < 4; k++) {
                double x[3];
                node_place(c, node[k], x);
                vec_axpy(centre, 0.25, x, centre);
            }
            if (distance_tree_within(c->tree, centre, tet_radius * c->edge + c->margin))
                c->kept[face] |= (uint8_t)(1 << side);
        }
    }
}

static tetmesh gather(const cubes *c)
{
    int64_t nodes = 2 * (c->size[0] + 1) * (c->size[1] + 1) * (c->size[2] + 1), tets = 0, node[4];
    int32_t *number = NEW_ARRAY(int32_t, nodes), used = 0;
    for (int64_t f = 0; f < 3 * cube_count(c); f++)
        for (int side = 0; side < PER_FACE; side++) {
            if (!(c->kept[f] >> side & 1)) continue;
            tet_nodes(c, f, side, node);
            for (int k = 0; k < 4; k++) number[node[k]] = 1;
            tets++;
        }
    for (int64_t i = 0; i < nodes; i++)
        if (number[i]) number[i] = ++used;
    tetmesh m = tetmesh_new(used, (int32_t)tets);
    for (int64_t i = 0; i < nodes; i++)
        if (number[i]) node_place(c, i, m.xyz + 3 * (size_t)(number[i] - 1));
    int32_t *tet = m.tet;
    for (int64_t f = 0; f < 3 * cube_count(c); f++)
        for (int side = 0; side < PER_FACE; side++) {
            if (!(c->kept[f] >> side & 1)) continue;
            tet_nodes(c, f, side, node);
            for (int k = 0; k < 4; k++) *tet++ = number[node[k]] - 1;
        }
    free(number);
    return m;
}

/* The cubes that hold all triangles with two to spare on each side. */
static bool make_cubes(const surface *all, double edge_mm, double margin_mm, cubes *c, err *e)
{
    double low[3], high[3], count = 1;
    surface_bounds(all, low, high);
    *c = (cubes){.edge = edge_mm, .margin = margin_mm};
    for (int a = 0; a < 3; a++) {
        double from = floor((low[a] - margin_mm) / edge_mm) - 2, to = floor((high[a] + margin_mm) / edge_mm) + 2;
        count *= to - from + 1;
        if (!(count <= 100.0 * MILLION))
            return err_set(e, ERR_RESOURCE,
                           "a lattice of %g mm over %.0f mm has too many cubes (the limit is 100 million)", edge_mm,
                           high[a] - low[a]);
        c->low[a] = (int64_t)from;
        c->size[a] = (int64_t)(to - from) + 1;
    }
    return true;
}

bool lattice_cover(const surface *const *list, int32_t count, double edge_mm, double margin_mm, tetmesh *out, err *e)
{
    if (!(edge_mm > 0) || !isfinite(edge_mm))
        return err_set(e, ERR_INPUT, "the edge of a lattice must be above 0 mm, got %g", edge_mm);
    if (!(margin_mm >= 0) || !isfinite(margin_mm))
        return err_set(e, ERR_INPUT, "the margin of a lattice must be 0 mm or more, got %g", margin_mm);
    surface all = {0};
    for (int32_t i = 0; i < count; i++) {
        surface next = surface_joined(&all, list[i]);
        surface_free(&all);
        all = next;
    }
    cubes c;
    bool ok = all.triangle_count > 0 || err_set(e, ERR_GEOMETRY, "a lattice needs a surface to lie around");
    ok = ok && make_cubes(&all, edge_mm, margin_mm, &c, e);
    if (ok) {
        distance_tree *tree = distance_tree_make(&all);
        c.tree = tree;
        c.kept = NEW_ARRAY(uint8_t, 3 * cube_count(&c));
        parallel_for(3 * cube_count(&c), FACE_GRAIN, keep_body, &c);
        *out = gather(&c);
        free(c.kept);
        distance_tree_free(&tree);
    }
    surface_free(&all);
    return ok;
}
