/* sdf_grid: signed distance to a closed surface, sampled on a regular grid. Negative inside. */
#pragma once
#include "geometry/surface.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct sdf_grid {
    int32_t size[3];
    double low[3], step_mm, band_mm; /* |value| is cut at band_mm */
    float *value;                    /* [size0*size1*size2], x fastest */
} sdf_grid;

/* Exact distances within band_mm of the surface. Inside is where the winding number along +x is positive, so that
 * shells that overlap count as their union; needs outward orientation. The caller frees *out. */
bool sdf_grid_make(const surface *s, const double low[3], const double high[3], double step_mm, double band_mm,
                   sdf_grid *out, err *e) MUST_CHECK;
void sdf_grid_free(sdf_grid *g);
/* Trilinear; outside the box the nearest value of the box. */
double sdf_grid_at(const sdf_grid *g, const double p[3]);
/* Unit gradient (central differences over one step); zero where the field is flat. */
void sdf_grid_normal(const sdf_grid *g, const double p[3], double n[3]);

#ifdef __cplusplus
}
#endif
