/* stage: small scenes that the picture tests share. */
#pragma once
#include "tests/check.h"
#include "render/picture.h"
#include "geometry/mem.h"
#include <string.h>

/* A closed box, outward. */
static inline surface box(double x0, double y0, double z0, double x1, double y1, double z1)
{
    static const int32_t tri[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    surface s = surface_new(8, 12);
    for (int v = 0; v < 8; v++) {
        s.xyz[3 * v] = v & 1 ? x1 : x0;
        s.xyz[3 * v + 1] = v & 2 ? y1 : y0;
        s.xyz[3 * v + 2] = v & 4 ? z1 : z0;
    }
    memcpy(s.tri, tri, sizeof tri);
    return s;
}

/* A finely divided ball. */
static inline surface ball(const double centre[3], double radius, int n)
{
    surface s = surface_new((n - 1) * 2 * n + 2, 4 * n * (n - 1));
    int32_t v = 0, t = 0, top = (n - 1) * 2 * n;
    for (int i = 1; i < n; i++)
        for (int j = 0; j < 2 * n; j++, v++) {
            double a = M_PI * i / n, b = M_PI * j / n;
            s.xyz[3 * v] = centre[0] + radius * sin(a) * cos(b);
            s.xyz[3 * v + 1] = centre[1] + radius * sin(a) * sin(b);
            s.xyz[3 * v + 2] = centre[2] + radius * cos(a);
        }
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 2; k++) s.xyz[3 * (top + k) + c] = centre[c] + (c == 2 ? (k ? -radius : radius) : 0);
    for (int j = 0; j < 2 * n; j++) {
        int32_t next = (j + 1) % (2 * n), last = (n - 2) * 2 * n;
        int32_t cap[6] = {top, j, next, top + 1, last + next, last + j};
        memcpy(s.tri + 3 * t, cap, sizeof cap);
        t += 2;
        for (int i = 0; i + 2 < n; i++) {
            int32_t a = i * 2 * n + j, b = i * 2 * n + next, c = a + 2 * n, d = b + 2 * n;
            int32_t quad[6] = {a, c, b, b, c, d};
            memcpy(s.tri + 3 * t, quad, sizeof quad);
            t += 2;
        }
    }
    return s;
}

/* Head axes that are the file axes. */
static inline head_frame straight_frame(void)
{
    return (head_frame){.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};
}

static inline picture_style small_style(void)
{
    picture_style s = picture_style_default();
    s.width = 160;
    s.height = 200;
    return s;
}

static inline model *make_model(studio *s, const surface *from, double crease_deg)
{
    err e = {0};
    model *m = NULL;
    model_params p = model_params_bone();
    p.crease_deg = crease_deg;
    p.normal_passes = 0;
    assert_ok(model_create(s, from, &p, &m, &e));
    return m;
}
