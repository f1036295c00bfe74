/* triangle: which way one triangle of a surface faces. */
#pragma once
#include "geometry/surface.h"
#include "geometry/vec.h"

/* Along the normal, as long as twice the area (mm2). */
static inline void triangle_area_vector(const surface *s, int32_t t, double out[3])
{
    const int32_t *v = s->tri + 3 * (size_t)t;
    double a[3], b[3];
    vec_sub(s->xyz + 3 * (size_t)v[1], s->xyz + 3 * (size_t)v[0], a);
    vec_sub(s->xyz + 3 * (size_t)v[2], s->xyz + 3 * (size_t)v[0], b);
    vec_cross(a, b, out);
}

/* Unit; zero of a triangle without area. */
static inline void triangle_normal(const surface *s, int32_t t, double out[3])
{
    triangle_area_vector(s, t, out);
    vec_normalize(out);
}
