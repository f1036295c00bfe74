/* assemble: energy, forces and the sparse stiffness of the whole tissue.
 *
 * The pattern is fixed by mesh and boundary numbering. Elements are evaluated in parallel into their own
 * slots; every nodal force, node-pair block and matrix entry is then gathered by its owner in element order,
 * so results do not depend on the number of threads. Memory: about 1 kB per tet. */
#pragma once
#include "sim/boundary.h"
#include "sim/element.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct assembly {
    int32_t node_count, unknown_count, tet_count;
    const int32_t *tet; /* borrowed from the mesh */
    elements el;        /* owned */
    /* elements around each node: source = 4 tet + local node */
    int32_t *node_start, *node_source;
    /* pairs (u <= v) of nodes in one tet; source = 2 (10 tet + element pair) + (1: block transposed), or -1 -
     * k for coupling k: first the pairs of `average`, then those of assembly_make, which are left to what
     * else adds to edge_block */
    int32_t edge_count;
    int32_t *edge_node, *edge_start, *edge_source;
    /* lower triangle by columns, rows ascending */
    int64_t *column_start, *row;
    double *value; /* mN/mm */
    int32_t *slot; /* [9*edge_count] matrix entry of each entry of a transformed block, -1: none here */
    /* entries that a second block feeds too (nodes that share an unknown) */
    int32_t shared_count;
    int32_t *shared_block, *shared_slot; /* block = 9 edge + entry */
    double *element_energy, *element_force, *element_block, *edge_block;
    struct averages *average; /* of volume changes, where a material asks for them, else NULL */
} assembly;

/* Takes *el over (leaves it empty) on success. coupling[2*coupling_count]: further pairs of nodes, low <
 * high, that the pattern is to hold. Refuses (ERR_RESOURCE) a mesh too large for its 32-bit numbers. */
bool assembly_make(const tetmesh *m, elements *el, const boundary *b, const int32_t *coupling, int32_t coupling_count,
                   assembly *out, err *e) MUST_CHECK;
void assembly_free(assembly *a);

/* Energy in uJ at x[3*node_count]; HUGE_VAL where a material has none. force[3*node_count] (may be NULL) in
 * mN. */
double assembly_energy(assembly *a, const double *x, double *force);
/* Fills edge_block at x. Not to be called where the energy is infinite. */
void assembly_stiffness(assembly *a, const double *x, projection how);
/* Fills value from edge_block and the boundary's present directions. */
void assembly_matrix(assembly *a, const boundary *b);
/* Number of the pair of nodes u <= v, -1 where the pattern has none; its node block [9] in edge_block, NULL so. */
int32_t assembly_edge(const assembly *a, int32_t u, int32_t v);
double *assembly_block(const assembly *a, int32_t u, int32_t v);
/* out[3*node_count] = edge_block times d[3*node_count], all nodes. */
void assembly_multiply(const assembly *a, const double *d, double *out);

/* The force that rounding alone makes: norm over all nodes, for coordinates as large as those of x. */
double assembly_force_noise(const assembly *a, const double *x);
/* Same for the energy at x, uJ. */
double assembly_energy_noise(const assembly *a, const double *x);

typedef struct deformation_extremes {
    double min_j, max_stretch; /* smallest det F, largest singular value of F */
    int32_t min_j_tet, max_stretch_tet;
    int32_t inverted_count; /* tets with det F <= 0 */
} deformation_extremes;

/* with_stretch false: max_stretch is left 0 (it costs a decomposition per tet). */
deformation_extremes assembly_extremes(const assembly *a, const double *x, bool with_stretch);

#ifdef __cplusplus
}
#endif
