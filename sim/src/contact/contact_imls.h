/* contact_imls: signed distance to a cloud of oriented samples. */
#pragma once
#include <stdint.h>

typedef struct imls_cloud {
    int32_t count;
    double *x, *n;    /* [3*count] mm; unit */
    double *area, *h; /* [count] mm2; support radius mm */
} imls_cloud;

void imls_free(imls_cloud *c);
/* Normals, areas and (support > 0) radii of `cloud` from its positions and triangles of its samples. */
void imls_shape(imls_cloud *cloud, const int32_t *tri, int32_t tri_count, double support);

typedef struct imls_value {
    double d, grad[3];
    double S; /* coverage */
} imls_value;

/* At x with radii times scale, over list[count]. S = 0: nothing is near, d = HUGE_VAL. weight[count]: w_i /
 * S. */
imls_value imls_at(const imls_cloud *cloud, const int32_t *list, int32_t count, double scale, const double x[3],
                   double *weight);

/* 0 below S = 0.02, 1 above 0.15. */
double imls_cover(double S);
