/* sphere: a closed test surface with exact radius at its vertices. */
#pragma once
#include "geometry/mem.h"
#include "geometry/surface.h"
#include "geometry/vec.h"
#include <math.h>

/* Rings of latitude, triangulated; the poles are vertices 0 and last. */
static inline surface sphere(const double centre[3], double radius, int rings)
{
    int around = 2 * rings;
    surface s = surface_new(2 + (rings - 1) * around, 2 * around * (rings - 1));
    const double pi = acos(-1.0);
    int32_t t = 0, last = s.vertex_count - 1;
    for (int32_t v = 0; v <= last; v++) {
        int ring = v == 0 ? 0 : v == last ? rings : 1 + (v - 1) / around, spoke = (v - 1) % around;
        double polar = pi * ring / rings, turn = 2 * pi * spoke / around;
        double n[3] = {sin(polar) * cos(turn), sin(polar) * sin(turn), cos(polar)};
        vec_axpy(centre, radius, n, s.xyz + 3 * (size_t)v);
    }
    for (int r = 0; r < rings; r++)
        for (int k = 0; k < around; k++) {
            int32_t next = (k + 1) % around, a = 1 + (r - 1) * around + k, b = 1 + (r - 1) * around + next,
                    c = 1 + r * around + k, d = 1 + r * around + next;
            int32_t two[2][3] = {{r == 0 ? 0 : a, c, d}, {a, d, b}};
            if (r == rings - 1) {
                int32_t cap[3] = {a, last, b};
                for (int i = 0; i < 3; i++) two[0][i] = cap[i];
            }
            for (int i = 0; i < (r == 0 || r == rings - 1 ? 1 : 2); i++, t++)
                for (int j = 0; j < 3; j++) s.tri[3 * t + j] = two[i][j];
        }
    s.triangle_count = t;
    return s;
}
