#include "sdf.h"
#include <assert.h>

double sdf_ellipsoid(const double p[3], double x, double y, double z, double a, double b, double c)
{
    double u[3] = {(p[0] - x) / a, (p[1] - y) / b, (p[2] - z) / c};
    double g[3] = {u[0] / a, u[1] / b, u[2] / c};
    double k0 = vec_norm(u), k1 = vec_norm(g);
    if (k1 < 1e-9) return -sdf_min(a, sdf_min(b, c));
    return k0 * (k0 - 1) / k1;
}

double sdf_ellipsoid_turned(const double p[3], const double centre[3], const double semi[3], double pitch, double yaw,
                            double roll)
{
    double d[3], q[3], t;
    vec_sub(p, centre, d);
    /* undo yaw (z), then pitch (x), then roll (y) */
    double c = cos(yaw), s = sin(yaw);
    q[0] = c * d[0] + s * d[1];
    q[1] = -s * d[0] + c * d[1];
    q[2] = d[2];
    c = cos(pitch), s = sin(pitch);
    t = c * q[1] + s * q[2];
    q[2] = -s * q[1] + c * q[2];
    q[1] = t;
    c = cos(roll), s = sin(roll);
    t = c * q[0] - s * q[2];
    q[2] = s * q[0] + c * q[2];
    q[0] = t;
    return sdf_ellipsoid(q, 0, 0, 0, semi[0], semi[1], semi[2]);
}

double sdf_cone(const double p[3], const double a[3], double ra, const double b[3], double rb)
{
    double ab[3], ap[3];
    vec_sub(b, a, ab);
    vec_sub(p, a, ap);
    double l2 = vec_dot(ab, ab);
    double t = l2 > 0 ? sdf_clamp(vec_dot(ap, ab) / l2, 0, 1) : 0;
    double q[3];
    vec_axpy(ap, -t, ab, q);
    return vec_norm(q) - sdf_mix(ra, rb, t);
}

double sdf_chain(const double p[3], const double (*points)[4], int count)
{
    double best = HUGE_VAL;
    for (int i = 0; i + 1 < count; i++) {
        double d = sdf_cone(p, points[i], points[i][3], points[i + 1], points[i + 1][3]);
        best = i == 0 ? d : sdf_union(best, d, 0.8 * sdf_min(points[i][3], points[i + 1][3]) + 1e-3);
    }
    return best;
}

double sdf_strip(const double p[3], const double (*points)[4], int count, const double across[3], double flat)
{
    /* Squeeze space along `across` about each segment's own axis, take the round distance there. */
    double best = HUGE_VAL;
    for (int i = 0; i + 1 < count; i++) {
        double ab[3], ap[3], q[3];
        vec_sub(points[i + 1], points[i], ab);
        vec_sub(p, points[i], ap);
        double l2 = vec_dot(ab, ab);
        double t = sdf_clamp(vec_dot(ap, ab) / l2, 0, 1);
        vec_axpy(ap, -t, ab, q);
        double w = vec_dot(q, across), r = sdf_mix(points[i][3], points[i + 1][3], t);
        double n[3];
        vec_axpy(q, -w, across, n);
        /* ellipse with semi-axes r*flat along across and r along the rest */
        double rest = vec_norm(n), k0 = sqrt(w * w / (flat * flat) + rest * rest) / r;
        double k1 = sqrt(w * w / (flat * flat * flat * flat) + rest * rest) / (r * r);
        double d = k1 < 1e-9 ? -r : k0 * (k0 - 1) / k1;
        best = i == 0 ? d : sdf_union(best, d, 0.8 * r + 1e-3);
    }
    return best;
}

double sdf_polygon(double u, double v, const double (*corners)[2], int count)
{
    double best = HUGE_VAL;
    int inside = 0;
    for (int i = 0, j = count - 1; i < count; j = i++) {
        double eu = corners[j][0] - corners[i][0], ev = corners[j][1] - corners[i][1];
        double wu = u - corners[i][0], wv = v - corners[i][1];
        double t = sdf_clamp((wu * eu + wv * ev) / (eu * eu + ev * ev), 0, 1);
        double du = wu - t * eu, dv = wv - t * ev;
        best = sdf_min(best, du * du + dv * dv);
        if ((corners[i][1] > v) != (corners[j][1] > v) && wu < eu * wv / ev) inside = !inside;
    }
    return inside ? -sqrt(best) : sqrt(best);
}

void sdf_spline(const double *points, int width, int count, double s, double *out)
{
    assert(count >= 2);
    s = sdf_clamp(s, 0, count - 1);
    int i = (int)sdf_min(floor(s), count - 2);
    double t = s - i;
    const double *b = points + width * i, *c = b + width;
    for (int k = 0; k < width; k++) {
        /* end points are mirrored through their neighbours */
        double a = i > 0 ? b[k - width] : 2 * b[k] - c[k];
        double d = i + 2 < count ? c[k + width] : 2 * c[k] - b[k];
        out[k] = b[k] + 0.5 * t * (c[k] - a + t * (2 * a - 5 * b[k] + 4 * c[k] - d + t * (3 * (b[k] - c[k]) + d - a)));
    }
}
