/* bodies: analytic closed surfaces for tests. */
#pragma once
#include "geometry/surface.h"
#include <string.h>

static inline surface body_box(double x0, double y0, double z0, double x1, double y1, double z1)
{
    static const int32_t tri[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                    1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    const double xyz[24] = {x0, y0, z0, x1, y0, z0, x1, y1, z0, x0, y1, z0,
                            x0, y0, z1, x1, y0, z1, x1, y1, z1, x0, y1, z1};
    surface s = surface_new(8, 12);
    memcpy(s.xyz, xyz, sizeof xyz);
    memcpy(s.tri, tri, sizeof tri);
    return s;
}

/* Latitudes and longitudes; volume of the polyhedron is a little below that of the ball. */
static inline surface body_ball(double x, double y, double z, double radius, int rings)
{
    const int around = 2 * rings;
    const double pi = 3.14159265358979323846;
    surface s = surface_new(2 + (rings - 1) * around, 2 * around * (rings - 1));
    int32_t t = 0;
    s.xyz[2] = radius;
    s.xyz[5] = -radius;
    for (int i = 1; i < rings; i++)
        for (int k = 0; k < around; k++) {
            double *p = s.xyz + 3 * (2 + (size_t)(i - 1) * (size_t)around + (size_t)k);
            p[0] = radius * sin(pi * i / rings) * cos(2 * pi * k / around);
            p[1] = radius * sin(pi * i / rings) * sin(2 * pi * k / around);
            p[2] = radius * cos(pi * i / rings);
        }
    for (int k = 0; k < around; k++) {
        int n = (k + 1) % around, last = 2 + (rings - 2) * around;
        const int32_t cap[6] = {0, 2 + k, 2 + n, 1, last + n, last + k};
        memcpy(s.tri + 3 * t, cap, sizeof cap);
        t += 2;
        for (int i = 0; i + 2 < rings; i++) {
            int a = 2 + i * around, b = a + around;
            const int32_t quad[6] = {a + k, b + k, b + n, a + k, b + n, a + n};
            memcpy(s.tri + 3 * t, quad, sizeof quad);
            t += 2;
        }
    }
    for (int32_t v = 0; v < s.vertex_count; v++) {
        s.xyz[3 * v] += x;
        s.xyz[3 * v + 1] += y;
        s.xyz[3 * v + 2] += z;
    }
    return s;
}

/* Puts b into a and frees both. */
static inline surface body_with(surface a, surface b)
{
    surface s = surface_joined(&a, &b);
    surface_free(&a);
    surface_free(&b);
    return s;
}
