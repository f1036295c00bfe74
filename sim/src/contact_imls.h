/* contact_imls: signed distance to a cloud of oriented samples. */
#pragma once
#include "geometry/surface.h"

typedef struct imls_cloud {
    int32_t count;
    double *x, *n;    /* [3*count] mm; unit */
    double *area, *h; /* [count] mm2; support radius mm */
} imls_cloud;

/* Vertices of s; support times the longest edge at each. Vertices in no triangle are left out. */
imls_cloud imls_of_surface(const surface *s, double support);
void imls_free(imls_cloud *c);
/* Normals, areas and (support > 0) radii of `cloud` from its positions and triangles of its samples. */
void imls_shape(imls_cloud *cloud, const int32_t *tri, int32_t tri_count, double support);

typedef struct imls_value {
    double d, grad[3];
    double S, S_grad[3]; /* coverage */
    double hess[9];
} imls_value;

/* At x with radii times scale, over list[count] (NULL: all samples). S = 0: nothing is near, d = HUGE_VAL.
 * weight[count] (may be NULL): w_i / S. */
imls_value imls_at(const imls_cloud *cloud, const int32_t *list, int32_t count, double scale,
                   const double x[3], bool with_hess, double *weight);

/* 0 below S = 0.02, 1 above 0.15. */
double imls_cover(double S);
