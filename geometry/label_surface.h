/* label_surface: closed surfaces of the parts of a label map, without the steps of its voxels. Each part's
 * indicator is smoothed with a Gaussian; a point belongs to the part whose smoothed indicator is largest
 * there (interpolated trilinearly). The mesh is made in mm, with geometry/label_mesher. */
#pragma once
#include "geometry/mask.h"
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct label_surface_params {
    /* A sheet one voxel thick still reaches 0.57 at its middle with 0.7; it would vanish with 1 (0.40). */
    double sigma_voxels;
    double edge_mm;     /* largest edge length, about */
    double distance_mm; /* largest distance of a triangle from the smoothed boundary, about */
    double least_mm3;   /* pieces and bubbles that enclose less are dropped */
} label_surface_params;

typedef struct label_surface_report {
    int32_t pieces_dropped;
    int32_t crowded_edges; /* of the raw mesh, where the part almost touches itself; repair parted them */
} label_surface_report;

label_surface_params label_surface_params_default(void);

typedef struct label_fields label_fields; /* the smoothed indicators; queries are const and thread-safe */

/* Masks of one grid, as many as there are parts; they may be empty. Copies what it needs. */
label_fields *label_fields_create(const volume *grid, const mask *parts, int part_count, double sigma_voxels);
void label_fields_destroy(label_fields **f);
/* Number of the part at p (LPS mm), -1 outside all. */
int label_fields_at(const label_fields *f, const double p[3]);

/* The boundary of one part, outward, closed (at the border of the volume too) and manifold. The caller frees
 * *out. Refuses (ERR_GEOMETRY) a part that is empty or smaller than least_mm3. report may be NULL. */
bool label_surface_make(const label_fields *f, int part, const label_surface_params *p, surface *out,
                        label_surface_report *report, err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
