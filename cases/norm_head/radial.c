#include "radial.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "dense.h"
#include "sdf.h"
#include <stdlib.h>

radial radial_through(const double centre[3], const double (*point)[3], int count)
{
    radial r = {0};
    vec_copy(centre, r.centre);
    r.direction = NEW_ARRAY(double, 6 * count);
    double *range = NEW_ARRAY(double, 2 * count + 4);
    for (int i = 0; i < count; i++) {
        for (int side = 0; side < (point[i][0] == 0 ? 1 : 2); side++) {
            double q[3] = {side ? -point[i][0] : point[i][0], point[i][1], point[i][2]}, d[3];
            vec_sub(q, centre, d);
            range[r.count] = vec_normalize(d);
            vec_copy(d, r.direction + 3 * r.count++);
        }
    }
    int n = r.count + 4;
    double *m = NEW_ARRAY(double, n *n);
    for (int i = 0; i < r.count; i++) {
        const double *u = r.direction + 3 * i;
        for (int j = 0; j < r.count; j++) {
            double d = vec_distance(u, r.direction + 3 * j);
            m[n * i + j] = d * d * d;
        }
        for (int k = 0; k < 4; k++) m[n * i + r.count + k] = m[n * (r.count + k) + i] = k == 0 ? 1 : u[k - 1];
    }
    dense_solve(m, range, n, 1);
    r.weight = range;
    free(m);
    return r;
}

void radial_free(radial *r)
{
    free(r->direction);
    free(r->weight);
    *r = (radial){0};
}

double radial_distance(const radial *r, const double p[3])
{
    double u[3];
    vec_sub(p, r->centre, u);
    double rho = vec_normalize(u);
    if (rho < 1) return -1;
    const double *w = r->weight, *tail = w + r->count;
    double value = tail[0] + vec_dot(tail + 1, u), gradient[3];
    vec_copy(tail + 1, gradient);
    for (int i = 0; i < r->count; i++) {
        const double *v = r->direction + 3 * i;
        double d2 = sdf_max(2 - 2 * vec_dot(u, v), 0), d = sqrt(d2);
        value += w[i] * d2 * d;
        vec_axpy(gradient, -3 * w[i] * d, v, gradient);
    }
    double along = vec_dot(gradient, u);
    vec_axpy(gradient, -along, u, gradient);
    return (rho - value) / sqrt(1 + vec_dot(gradient, gradient) / (rho * rho));
}
