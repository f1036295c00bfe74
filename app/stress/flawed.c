/* Meshes and attachment maps with one flaw. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <assert.h>
#include <string.h>

/* Room for more nodes and tets behind those of m. */
static void grow(tetmesh *m, int32_t nodes, int32_t tets)
{
    tetmesh more = tetmesh_new(m->vertex_count + nodes, m->tet_count + tets);
    memcpy(more.xyz, m->xyz, 3 * (size_t)m->vertex_count * sizeof *m->xyz);
    memcpy(more.tet, m->tet, 4 * (size_t)m->tet_count * sizeof *m->tet);
    tetmesh_free(m);
    *m = more;
}

/* The cells from layer `from` up get their own nodes at that height, but for those that `keep` accepts. */
static void crack(const stress_case *c, tetmesh *m, int from, bool keep(const int n[3], int32_t in_layer))
{
    int32_t layer = (c->cells[0] + 1) * (c->cells[1] + 1), first = layer * from, fresh = m->vertex_count;
    int32_t upper = 5 * c->cells[0] * c->cells[1] * from, *copy = NEW_ARRAY(int32_t, layer);
    grow(m, layer, 0);
    for (int32_t i = 0; i < layer; i++) {
        copy[i] = first + i;
        if (keep && keep(c->cells, i)) continue;
        vec_copy(m->xyz + 3 * (size_t)(first + i), m->xyz + 3 * (size_t)fresh);
        copy[i] = fresh++;
    }
    for (int32_t i = 4 * upper; i < 4 * m->tet_count; i++)
        if (m->tet[i] >= first && m->tet[i] < first + layer) m->tet[i] = copy[m->tet[i] - first];
    m->vertex_count = fresh;
    free(copy);
}

static bool on_edge(const int n[3], int32_t in_layer) { return in_layer % (n[0] + 1) == 0; }

static bool in_corner(const int n[3], int32_t in_layer)
{
    (void)n;
    return in_layer == 0;
}

static bool apart_from_first(const int n[3], int32_t in_layer)
{
    (void)n;
    return in_layer != 5;
}

static void damage(const stress_case *c, tetmesh *m)
{
    int middle = c->cells[2] / 2;
    switch ((mesh_flaw)c->flaw) {
    case FLAW_CRACK:
    case FLAW_ISLAND:
    case FLAW_ISLAND_ONE:
    case FLAW_ISLAND_TWO: crack(c, m, middle, NULL); return;
    case FLAW_DOUBLE: crack(c, m, middle, apart_from_first); return;
    case FLAW_HINGE: crack(c, m, middle, on_edge); return;
    case FLAW_POINT: crack(c, m, middle, in_corner); return;
    case FLAW_FLAT: { /* a tet in a face of the surface */
        const int32_t q[4] = {stress_node(c->cells, 0, 0, 1), stress_node(c->cells, 0, 1, 1),
                              stress_node(c->cells, 0, 0, 2), stress_node(c->cells, 0, 1, 2)};
        grow(m, 0, 1);
        memcpy(m->tet + 4 * (size_t)(m->tet_count - 1), q, sizeof q);
        return;
    }
    case FLAW_TURNED: {
        int32_t keep = m->tet[0];
        m->tet[0] = m->tet[1];
        m->tet[1] = keep;
        return;
    }
    case FLAW_NAN: m->xyz[3 * (size_t)stress_node(c->cells, 1, 1, 1)] = (double)NAN; return;
    case FLAW_INFINITE: m->xyz[3 * (size_t)stress_node(c->cells, 1, 1, 1) + 2] = HUGE_VAL; return;
    case FLAW_INDEX: m->tet[17] = m->vertex_count; return;
    case FLAW_LOOSE: grow(m, 1, 0); return;
    case FLAW_TWICE:
        grow(m, 0, 1);
        memcpy(m->tet + 4 * (size_t)(m->tet_count - 1), m->tet, 4 * sizeof *m->tet);
        return;
    case FLAW_REGION: m->region[3] = 2; return;
    case FLAW_SLIDES:
    case FLAW_NORMAL:
    case FLAW_SEGMENT:
    case FLAW_COUNT:
    case FLAW_PAIR: return;
    }
    assert(0);
}

static void slide(attach_map *a, int32_t v, double normal)
{
    a->kind[v] = NODE_SLIDING;
    a->segment[v] = SEGMENT_CRANIUM;
    a->normal[3 * (size_t)v + 2] = normal;
}

static void mishang(const stress_case *c, stress_scene *s)
{
    int32_t layer = (c->cells[0] + 1) * (c->cells[1] + 1), top = layer * c->cells[2];
    attach_map *a = &s->attach;
    int held = c->flaw == FLAW_ISLAND_ONE ? 1 : c->flaw == FLAW_ISLAND_TWO ? 2 : 0;
    switch (c->flaw) {
    case FLAW_ISLAND:
    case FLAW_ISLAND_ONE:
    case FLAW_ISLAND_TWO:
    case FLAW_HINGE:
    case FLAW_POINT:
        for (int32_t v = top + held; v < top + layer; v++) {
            a->kind[v] = NODE_FREE;
            a->segment[v] = -1;
        }
        return;
    case FLAW_SLIDES:
        for (int32_t v = 0; v < a->node_count; v++) a->kind[v] = NODE_FREE;
        for (int32_t v = 0; v < layer; v++) slide(a, v, 1);
        return;
    case FLAW_NORMAL: slide(a, layer, 0.5); return;
    case FLAW_SEGMENT: a->segment[2] = SEGMENT_COUNT; return;
    case FLAW_COUNT: a->node_count--; return;
    case FLAW_PAIR:
        attach_map_free(a);
        *a = attach_map_new(s->mesh.vertex_count, 1);
        stress_tie_ends(c, s);
        a->pair[0] = a->pair[1] = layer;
        a->pair_normal[2] = 1;
        return;
    }
}

void specimen_broken(const stress_case *c, stress_scene *s)
{
    s->mesh = stress_grid(c->cells, c->size, c->cells[2]);
    damage(c, &s->mesh);
    s->attach = attach_map_new(s->mesh.vertex_count, 0);
    stress_tie_ends(c, s);
    mishang(c, s);
}
