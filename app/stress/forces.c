/* Deformation and forces written down a second time, tet by tet, with nothing of the solver but the stress of
 * a material. */
#include "app/stress/stress.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdlib.h>
#include <string.h>

void stress_deformation(const tetmesh *m, const double *x, int32_t t, double F[9], double g[12], double *volume)
{
    const int32_t *v = m->tet + 4 * (size_t)t;
    double D[3][3], d[3][3], six;
    for (int a = 0; a < 3; a++) {
        vec_sub(m->xyz + 3 * (size_t)v[a + 1], m->xyz + 3 * (size_t)v[0], D[a]);
        vec_sub(x + 3 * (size_t)v[a + 1], x + 3 * (size_t)v[0], d[a]);
    }
    for (int a = 0; a < 3; a++) vec_cross(D[(a + 1) % 3], D[(a + 2) % 3], g + 3 * (a + 1));
    six = vec_dot(D[0], g + 3);
    memset(g, 0, 3 * sizeof *g);
    for (int a = 1; a < 4; a++) {
        vec_scale(g + 3 * a, 1 / six, g + 3 * a);
        vec_sub(g, g + 3 * a, g);
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) F[3 * i + j] = d[0][i] * g[3 + j] + d[1][i] * g[6 + j] + d[2][i] * g[9 + j];
    *volume = six / 6;
}

static int material_at(const stress_scene *s, int32_t t) { return s->mesh.region[t] && s->material_count > 1; }

/* Pressures of averaged volume changes at each node in either material, and their energy. Caller frees. */
static double *node_pressures(const stress_scene *s, const double *x, double *energy)
{
    int32_t n = s->mesh.vertex_count;
    double *before = NEW_ARRAY(double, 2 * (size_t)n), *after = NEW_ARRAY(double, 2 * (size_t)n);
    for (int32_t t = 0; t < s->mesh.tet_count; t++) {
        double F[9], g[12], volume;
        stress_deformation(&s->mesh, x, t, F, g, &volume);
        for (int a = 0; a < 4; a++) {
            int32_t at = s->mesh.tet[4 * (size_t)t + a] + n * material_at(s, t);
            before[at] += volume / 4;
            after[at] += volume / 4 * mat_det(F);
        }
    }
    for (int32_t i = 0; i < 2 * n; i++) {
        double kpa = s->material[i / n].material.averaged_kpa, change = before[i] > 0 ? after[i] / before[i] - 1 : 0;
        *energy += before[i] * kpa / 2 * change * change;
        after[i] = kpa * change;
    }
    free(before);
    return after;
}

double stress_forces(const stress_scene *s, const double *x, double *force)
{
    const tetmesh *m = &s->mesh;
    double energy = 0, *pressure = node_pressures(s, x, &energy);
    memset(force, 0, 3 * (size_t)m->vertex_count * sizeof *force);
    for (int32_t t = 0; t < m->tet_count; t++) {
        double F[9], g[12], P[9], volume, push[3];
        const int32_t *v = m->tet + 4 * (size_t)t;
        stress_deformation(&s->mesh, x, t, F, g, &volume);
        material one = s->material[material_at(s, t)].material;
        one.lambda_kpa -= one.averaged_kpa;
        energy += volume * material_energy(&one, F);
        for (int a = 0; a < 4; a++) one.pressure_kpa += pressure[v[a] + m->vertex_count * material_at(s, t)] / 4;
        material_stress(&one, F, P);
        for (int a = 0; a < 4; a++) {
            mat_apply(P, g + 3 * a, push);
            vec_axpy(force + 3 * (size_t)v[a], volume, push, force + 3 * (size_t)v[a]);
        }
    }
    free(pressure);
    return energy;
}
