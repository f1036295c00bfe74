/* lips: a block in two halves that lie on each other, with every kind of node. */
#pragma once
#include "tests/physics/block.h"

/* A block whose nodes at height layer `cut` are doubled and paired (normal +z). The bottom is tied to the
 * distal segment, the top to the maxilla; where `with_sliding`, side x = 0 slides on the cranium. */
static inline tetmesh lips_mesh(const block *b, int cut, bool with_sliding, attach_map *a)
{
    tetmesh whole = block_mesh(b);
    int32_t layer = (b->nx + 1) * (b->ny + 1), first = layer * cut, n = whole.vertex_count;
    tetmesh m = tetmesh_new(n + layer, whole.tet_count);
    for (int32_t i = 0; i < 3 * n; i++) m.xyz[i] = whole.xyz[i];
    for (int32_t i = 0; i < layer; i++) {
        double *x = m.xyz + 3 * (size_t)(first + i), *y = m.xyz + 3 * (size_t)(n + i);
        x[2] = b->size[2] * cut / b->nz; /* jitter would make the lips cross */
        vec_copy(x, y);
    }
    for (int32_t t = 0; t < m.tet_count; t++) {
        bool below = t / b->tets / (b->nx * b->ny) < cut;
        for (int k = 0; k < 4; k++) {
            int32_t v = whole.tet[4 * (size_t)t + k];
            m.tet[4 * (size_t)t + k] = below && v >= first && v < first + layer ? n + v - first : v;
        }
    }
    tetmesh_free(&whole);
    *a = attach_map_new(m.vertex_count, layer);
    for (int32_t i = 0; i < layer; i++) {
        a->pair[2 * i] = first + i;
        a->pair[2 * i + 1] = n + i;
        a->pair_normal[3 * i + 2] = 1;
    }
    for (int32_t v = 0; v < n; v++) {
        const double *x = m.xyz + 3 * (size_t)v;
        if (v < layer)
            tie(a, v, SEGMENT_DISTAL);
        else if (v >= n - layer)
            tie(a, v, SEGMENT_MAXILLA);
        else if (with_sliding && x[0] == 0 && (v < first || v >= first + layer)) {
            a->kind[v] = NODE_SLIDING;
            a->segment[v] = SEGMENT_CRANIUM;
            a->normal[3 * (size_t)v] = 1;
        }
    }
    return m;
}
