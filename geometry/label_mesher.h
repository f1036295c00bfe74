/* label_mesher: conforming tetrahedra of a domain given by a label function (CGAL Mesh_3, geometry/cgal).
 * Used for soft tissue, for surfaces of label maps and for implicit bodies. */
#pragma once
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Label at p: 0 outside, 1.. a region. Must be pure: same p, same label. */
typedef int label_function(const double p[3], void *context);
/* Wanted edge length at p in mm, for cells (region > 0) and for facets (region 0). */
typedef double size_function(const double p[3], int region, void *context);

typedef struct label_mesher_params {
    double low[3], high[3];   /* a box that contains the domain */
    double facet_angle_deg;   /* smallest angle of a boundary facet, at most 30 */
    double facet_distance_mm; /* largest distance from a boundary facet to the true boundary */
    double cell_radius_edge;  /* largest circumradius / shortest edge, at least 2 */
    double boundary_error_mm; /* bisection error of points on the boundary */
    bool surface_only;        /* no size limit on cells: boundary facets are all that matters */
    bool optimise;            /* perturb and exude slivers */
    double time_limit_s;      /* of each optimiser; 0: until done (a limit makes results depend on the
                                 machine's load: only for previews) */
} label_mesher_params;

label_mesher_params label_mesher_params_default(void);

/* Tets of every labelled region; region[] holds the label. facet_size and cell_size may be the same function.
 * The caller frees *out. Refuses (ERR_GEOMETRY) a domain that is empty. */
bool label_mesher_run(label_function *label, size_function *size, void *context, const label_mesher_params *p,
                      tetmesh *out, err *e) MUST_CHECK;

/* The boundary of all tets with region[t] == label, outward, closed. The caller frees. */
surface label_mesher_surface(const tetmesh *m, int label);

#ifdef __cplusplus
}
#endif
