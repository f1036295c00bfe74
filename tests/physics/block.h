/* block: small tetrahedral test bodies. */
#pragma once
#include "geometry/attach_map.h"
#include "geometry/mem.h"
#include "geometry/rigid.h"
#include "geometry/segments.h"
#include "geometry/tetmesh.h"
#include "geometry/vec.h"
#include <assert.h>

/* In [-1, 1), the same on every machine. */
static inline double block_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

typedef struct block {
    int nx, ny, nz; /* cells */
    double size[3]; /* mm */
    int tets;       /* per cell: 6 (around one diagonal) or 5 (alternating, chequered) */
    double jitter;  /* of inner nodes, as a fraction of the cell */
} block;

static inline int32_t block_node(const block *b, int i, int j, int k)
{
    return (k * (b->ny + 1) + j) * (b->nx + 1) + i;
}

static inline tetmesh block_mesh(const block *b)
{
    static const int six[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    static const int five[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    assert(b->tets == 6 || b->tets == 5);
    tetmesh m = tetmesh_new((b->nx + 1) * (b->ny + 1) * (b->nz + 1), b->tets * b->nx * b->ny * b->nz);
    uint64_t seed = 1;
    double cell[3] = {b->size[0] / b->nx, b->size[1] / b->ny, b->size[2] / b->nz};
    for (int k = 0; k <= b->nz; k++)
        for (int j = 0; j <= b->ny; j++)
            for (int i = 0; i <= b->nx; i++) {
                double *x = m.xyz + 3 * (size_t)block_node(b, i, j, k);
                int at[3] = {i, j, k};
                bool inner = i > 0 && j > 0 && k > 0 && i < b->nx && j < b->ny && k < b->nz;
                for (int c = 0; c < 3; c++) x[c] = cell[c] * (at[c] + (inner ? b->jitter * block_random(&seed) : 0));
            }
    int32_t t = 0;
    for (int k = 0; k < b->nz; k++)
        for (int j = 0; j < b->ny; j++)
            for (int i = 0; i < b->nx; i++)
                for (int n = 0; n < b->tets; n++, t++) {
                    int32_t *tet = m.tet + 4 * (size_t)t;
                    bool odd = b->tets == 5 && (i + j + k) % 2 == 1;
                    for (int a = 0; a < 4; a++) {
                        int corner = (b->tets == 6 ? six[n][a] : five[n][a]) ^ (odd ? 1 : 0);
                        tet[a] = block_node(b, i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
                    }
                    const double *x[4];
                    for (int a = 0; a < 4; a++) x[a] = m.xyz + 3 * (size_t)tet[a];
                    if (vec_six_volume(x[0], x[1], x[2], x[3]) < 0) {
                        int32_t s = tet[2];
                        tet[2] = tet[3];
                        tet[3] = s;
                    }
                }
    return m;
}

static inline void tie(attach_map *a, int32_t v, segment_id segment)
{
    a->kind[v] = NODE_TIED;
    a->segment[v] = (int32_t)segment;
}

/* The slab of the cross_solver data, any fineness: lies on a cylinder of 80 mm, its bone side tied to the
 * cranium but for a patch that belongs to the maxilla and a free ring of 10 mm around it. */
static inline tetmesh slab_mesh(int nx, int ny, int nz, attach_map *a)
{
    block b = {nx, ny, nz, {150, 180, 25}, 6, 0};
    tetmesh m = block_mesh(&b);
    *a = attach_map_new(m.vertex_count, 0);
    for (int32_t v = 0; v < m.vertex_count; v++) {
        double *x = m.xyz + 3 * (size_t)v, u = x[0] - 75, w = x[1] - 90, depth = x[2];
        if (depth == 0) {
            double du = fmax(fabs(u) - 25, 0), dw = fmax(fabs(w) - 20, 0), off = sqrt(du * du + dw * dw);
            if (off == 0)
                tie(a, v, SEGMENT_MAXILLA);
            else if (off > 10)
                tie(a, v, SEGMENT_CRANIUM);
        }
        x[0] = (80 + depth) * sin(u / 80);
        x[1] = w;
        x[2] = (80 + depth) * cos(u / 80);
    }
    return m;
}

/* A flat plate of 240 x 160 x 12 mm on bone, large against its thickness: a patch of 32 x 32 mm in its middle belongs
 * to the maxilla, with a free ring of 8 mm around it. */
static inline tetmesh plate_mesh(int nx, int ny, int nz, attach_map *a)
{
    block b = {nx, ny, nz, {240, 160, 12}, 6, 0};
    tetmesh m = block_mesh(&b);
    *a = attach_map_new(m.vertex_count, 0);
    for (int32_t v = 0; v < m.vertex_count; v++) {
        const double *x = m.xyz + 3 * (size_t)v;
        double off = fmax(fabs(x[0] - 120), fabs(x[1] - 80)) - 16;
        if (x[2] > 0 || (off > 0 && off <= 8)) continue;
        tie(a, v, off > 0 ? SEGMENT_CRANIUM : SEGMENT_MAXILLA);
    }
    return m;
}

static inline void rest_motions(rigid motion[SEGMENT_COUNT])
{
    for (int s = 0; s < SEGMENT_COUNT; s++) motion[s] = rigid_identity();
}
