#include "sim/src/contact/contact_imls.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

void imls_shape(imls_cloud *c, const int32_t *tri, int32_t tri_count, double support)
{
    memset(c->n, 0, 3 * (size_t)c->count * sizeof *c->n);
    memset(c->area, 0, (size_t)c->count * sizeof *c->area);
    if (support > 0) memset(c->h, 0, (size_t)c->count * sizeof *c->h);
    for (int32_t t = 0; t < tri_count; t++) {
        const int32_t *v = tri + 3 * (size_t)t;
        double u[3], w[3], n[3];
        vec_sub(c->x + 3 * (size_t)v[1], c->x + 3 * (size_t)v[0], u);
        vec_sub(c->x + 3 * (size_t)v[2], c->x + 3 * (size_t)v[0], w);
        vec_cross(u, w, n);
        double area = vec_norm(n) / 2;
        for (int k = 0; k < 3; k++) {
            vec_add(c->n + 3 * (size_t)v[k], n, c->n + 3 * (size_t)v[k]);
            c->area[v[k]] += area / 3;
            if (!(support > 0)) continue;
            int32_t next = v[(k + 1) % 3];
            double h = support * vec_distance(c->x + 3 * (size_t)v[k], c->x + 3 * (size_t)next);
            c->h[v[k]] = fmax(c->h[v[k]], h);
            c->h[next] = fmax(c->h[next], h);
        }
    }
    for (int32_t i = 0; i < c->count; i++) vec_normalize(c->n + 3 * (size_t)i);
}

void imls_free(imls_cloud *c)
{
    free(c->x);
    free(c->n);
    free(c->area);
    free(c->h);
    *c = (imls_cloud){0};
}

imls_value imls_at(const imls_cloud *c, const int32_t *list, int32_t count, double scale, const double x[3],
                   double *weight)
{
    imls_value v = {.d = HUGE_VAL};
    double sum = 0, normal[3] = {0};
    for (int32_t k = 0; k < count; k++) {
        int32_t i = list[k];
        double r[3], H = scale * c->h[i];
        vec_sub(x, c->x + 3 * (size_t)i, r);
        double q = 1 - vec_dot(r, r) / (H * H);
        weight[k] = 0;
        if (!(q > 0)) continue;
        weight[k] = 5 * c->area[i] / (pi * H * H) * q * q * q * q;
        v.S += weight[k];
        sum += weight[k] * vec_dot(c->n + 3 * (size_t)i, r);
        vec_axpy(normal, weight[k], c->n + 3 * (size_t)i, normal);
    }
    if (!(v.S > 0)) return v;
    v.d = sum / v.S;
    double turn[3] = {0};
    for (int32_t k = 0; k < count; k++) {
        weight[k] /= v.S;
        int32_t i = list[k];
        double r[3], H = scale * c->h[i];
        vec_sub(x, c->x + 3 * (size_t)i, r);
        double q = 1 - vec_dot(r, r) / (H * H);
        if (!(q > 0)) continue;
        double kappa = 5 * c->area[i] / (pi * H * H), off = vec_dot(c->n + 3 * (size_t)i, r) - v.d;
        double g[3];
        vec_scale(r, -8 * kappa / (H * H) * q * q * q, g);
        vec_axpy(turn, off, g, turn);
    }
    for (int a = 0; a < 3; a++) v.grad[a] = (normal[a] + turn[a]) / v.S;
    return v;
}

double imls_cover(double S)
{
    static const double low = 0.02, high = 0.15;
    double t = (S - low) / (high - low);
    return !(t > 0) ? 0 : t >= 1 ? 1 : t * t * t * (10 + t * (6 * t - 15));
}
