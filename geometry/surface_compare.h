/* surface_compare: how far one skin lies from another, and where. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

/* Per vertex of `from`: the distance in mm to the closest point of `to`, positive where `to` lies in front (outside)
 * of `from`, by the normal of `from`. NaN where the closest point lies on an open border of `to` (the other scan ends
 * there) and where a vertex has no triangle. It is a distance between surfaces: it does not see how far the tissue
 * slid along them. out[from->vertex_count]. Refuses what surface_check and nearest_create refuse. */
bool surface_signed_distance(const surface *from, const surface *to, double *out, err *e) MUST_CHECK;

typedef struct distance_stats { /* each vertex counts once; mm */
    int32_t count, left_out;    /* left_out: NaN */
    double mean, mean_abs, rms; /* NaN where count is 0 */
    double p90, p95;            /* of the absolute value; the smallest value that this share does not exceed */
    double under_1, under_2;    /* share, 0..1 */
} distance_stats;

/* Over the vertices with selected[v] == value. */
distance_stats distance_summary(const double *signed_mm, const uint8_t *selected, uint8_t value, int32_t count);

typedef struct surface_fit {
    rigid move;           /* brings `moving` onto `still` */
    int32_t points, used; /* of `still`; used: after trimming, in the last iteration */
    int iterations;
    double rms_before_mm, rms_after_mm; /* of the used points: point to surface */
} surface_fit;

/* Rigid registration of `moving` onto the selected vertices of `still`: iterative closest points with the
 * point-to-plane step (Chen and Medioni, "Object modelling by registration of multiple range images", Image and
 * Vision Computing 10, 1992), trimmed to the closest 80 % (Chetverikov et al., "The Trimmed Iterative Closest Point
 * algorithm", ICPR 2002). Refuses (ERR_GEOMETRY) fewer than 100 points, surfaces of which half lies farther than 20 mm
 * apart at the start, and a selection that leaves the motion open (a plane, a sphere). */
bool surface_fit_rigid(const surface *moving, const surface *still, const uint8_t *selected, surface_fit *out,
                       err *e) MUST_CHECK;

#ifdef __cplusplus
}
#endif
