/* small_head: a template of a few hundred vertices, of ellipsoids: no face, but all that a template has, at once. And
 * shapes of it, bent smoothly by a few numbers. */
#pragma once
#include "app/planner/identity/head.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static inline surface small_ball(double x, double y, double z, double rx, double ry, double rz, int rings)
{
    int around = 2 * rings;
    surface s = surface_new((rings - 1) * around + 2, 2 * around * (rings - 1));
    int32_t *t = s.tri, top = 0, bottom = s.vertex_count - 1;
    double *p = s.xyz;
    *p++ = x, *p++ = y, *p++ = z + rz;
    for (int i = 1; i < rings; i++)
        for (int k = 0; k < around; k++) {
            double a = M_PI * i / rings, b = 2 * M_PI * k / around;
            *p++ = x + rx * sin(a) * cos(b), *p++ = y + ry * sin(a) * sin(b), *p++ = z + rz * cos(a);
        }
    *p++ = x, *p++ = y, *p++ = z - rz;
    for (int k = 0; k < around; k++) {
        int next = (k + 1) % around, last = 1 + (rings - 2) * around;
        *t++ = top, *t++ = 1 + k, *t++ = 1 + next;
        for (int i = 0; i < rings - 2; i++) {
            int a = 1 + i * around + k, b = 1 + i * around + next, c = a + around, d = b + around;
            *t++ = a, *t++ = c, *t++ = d;
            *t++ = a, *t++ = d, *t++ = b;
        }
        *t++ = last + k, *t++ = bottom, *t++ = last + next;
    }
    return s;
}

/* Two rows of cubes, of six tetrahedra each, in front of the bones. */
static inline tetmesh small_block(void)
{
    enum { NX = 6, NY = 2, NZ = 6 };
    static const int way[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    tetmesh m = tetmesh_new((NX + 1) * (NY + 1) * (NZ + 1), NX * NY * NZ * 6);
    double *p = m.xyz;
    for (int z = 0; z <= NZ; z++)
        for (int y = 0; y <= NY; y++)
            for (int x = 0; x <= NX; x++) *p++ = 16 * (x - 3), *p++ = -100 + 20 * y, *p++ = 16 * (z - 5);
    int32_t *t = m.tet;
    for (int cell = 0; cell < NX * NY * NZ; cell++)
        for (int w = 0; w < 6; w++) {
            int at[3] = {cell % NX, cell / NX % NY, cell / NX / NY};
            for (int k = 0; k < 4; k++) {
                t[k] = at[0] + (NX + 1) * (at[1] + (NY + 1) * at[2]);
                if (k < 3) at[way[w][k]]++;
            }
            if (w == 1 || w == 2 || w == 5) { /* odd orders of the axes are left-handed */
                int32_t swap = t[0];
                t[0] = t[1];
                t[1] = swap;
            }
            t += 4;
        }
    return m;
}

static inline head_template small_head(void)
{
    head_template t = {
        .version = 1, .numbering = "5ma11", .hash = "5ma11", .point_count = 4, .point = NEW_ARRAY(head_point, 4)};
    t.part[CASE_SKIN] = small_ball(0, 0, 0, 80, 100, 120, 16);
    t.part[CASE_SKULL] = small_ball(0, 0, 30, 60, 75, 70, 12);
    t.part[CASE_MANDIBLE] = small_ball(0, -30, -75, 30, 30, 15, 8);
    for (int row = 0; row < 2; row++) {
        surface *teeth = &t.part[row ? CASE_LOWER_TEETH : CASE_UPPER_TEETH];
        double z = row ? -56 : -45;
        surface left = small_ball(8, -50, z, 4, 4, 5, 6), right = small_ball(-8, -50, z, 4, 4, 5, 6);
        *teeth = surface_joined(&left, &right);
        t.tooth[row ? CASE_LOWER_TEETH : CASE_UPPER_TEETH] = NEW_ARRAY(int32_t, teeth->vertex_count);
        for (int i = left.vertex_count; i < teeth->vertex_count; i++)
            t.tooth[row ? CASE_LOWER_TEETH : CASE_UPPER_TEETH][i] = 1;
        surface_free(&left);
        surface_free(&right);
    }
    t.tissue.mesh = small_block();
    t.rest = COPY_ARRAY(double, t.tissue.mesh.xyz, 3 * (size_t)t.tissue.mesh.vertex_count);
    for (int i = 0; i < t.tissue.mesh.vertex_count; i++) t.rest[3 * i + 2] += 0.01 * t.rest[3 * i];
    t.skin_on_tissue =
        embed_points(&t.tissue.mesh, t.part[CASE_SKIN].xyz, t.part[CASE_SKIN].vertex_count, 12, NULL, NULL);
    static const char *const label[] = {"Po_L", "Po_R", "Or_L", "Or_R"};
    static const double dir[4][2] = {{1, 0.1}, {-1, 0.1}, {0.5, -0.8}, {-0.5, -0.8}}; /* left, posterior */
    const surface *skull = &t.part[CASE_SKULL];
    for (int k = 0; k < 4; k++) { /* the triangle whose middle is nearest to the direction, at the skull's equator */
        double best = HUGE_VAL;
        head_point *p = &t.point[k];
        *p = (head_point){.part = CASE_SKULL, .weight = {1, 0, 0}};
        strcpy(p->label, label[k]);
        for (int i = 0; i < skull->triangle_count; i++) {
            const double *q = skull->xyz + 3 * skull->tri[3 * i];
            double d = hypot(hypot(q[0] - 60 * dir[k][0], q[1] - 75 * dir[k][1]), q[2] - 10);
            if (d < best) best = d, p->triangle = i, memcpy(p->at, q, sizeof p->at);
        }
    }
    return t;
}

enum { SMALL_BENDS = 5 };

static inline void small_bend(const double c[SMALL_BENDS], double *xyz, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        double *p = xyz + 3 * i, x = p[0] / 100, y = p[1] / 100, z = p[2] / 100;
        p[0] += c[0] * x + c[3] * x * z;
        p[1] += c[1] * z * z + c[4] * y;
        p[2] += c[2] * z;
    }
}

static inline head_shape small_shape(const head_template *t, const double c[SMALL_BENDS])
{
    head_shape s = head_shape_of(t);
    for (int k = 0; k < CASE_SURFACE_COUNT; k++) small_bend(c, s.part[k], t->part[k].vertex_count);
    small_bend(c, s.rest, t->tissue.mesh.vertex_count);
    small_bend(c, s.neutral, t->tissue.mesh.vertex_count);
    return s;
}
