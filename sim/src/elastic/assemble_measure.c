#include "sim/src/elastic/assemble_parts.h"
#include "sim/src/elastic/svd3.h"
#include <float.h>

/* Rounding of F: coordinates lose eps |x|, divided by the size of the tet. */
static double element_noise(const assembly *a, int32_t t, const double *x, double *stiffness, double *steepest)
{
    double reach = 0, g = 0, x_e[12];
    element_nodes(a->tet, t, x, x_e);
    for (int c = 0; c < 12; c++) reach = fmax(reach, fabs(x_e[c]));
    for (int k = 0; k < 4; k++) g = fmax(g, vec_norm(a->el.gradient + 12 * (size_t)t + 3 * k));
    const struct material *m = &a->el.materials[a->el.material[t]];
    *stiffness = (2 * m->mu_kpa + fabs(m->lambda_kpa)) * a->el.volume[t];
    *steepest = g;
    return 4 * DBL_EPSILON * (1 + reach * g);
}

double assembly_force_noise(const assembly *a, const double *x)
{
    double sum = 0;
    for (int32_t t = 0; t < a->tet_count; t++) {
        double stiffness, g, noise = element_noise(a, t, x, &stiffness, &g);
        sum += stiffness * g * noise * stiffness * g * noise;
    }
    return 4 * sqrt(sum);
}

double assembly_energy_noise(const assembly *a, const double *x)
{
    double sum = 0;
    for (int32_t t = 0; t < a->tet_count; t++) {
        double stiffness, g, x_e[12], F[9];
        double noise = element_noise(a, t, x, &stiffness, &g), strain = noise;
        element_nodes(a->tet, t, x, x_e);
        element_gradient_F(a->el.gradient + 12 * (size_t)t, x_e, F);
        for (int i = 0; i < 9; i++) strain = fmax(strain, fabs(F[i] - (i % 4 == 0)));
        sum += stiffness * strain * noise * stiffness * strain * noise;
    }
    return sqrt(sum);
}

/* No singular value is larger: Gershgorin on F^T F. */
static double stretch_bound(const double F[9])
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int j = 0; j < 3; j++) sum += fabs(F[i] * F[j] + F[3 + i] * F[3 + j] + F[6 + i] * F[6 + j]);
        most = fmax(most, sum);
    }
    return sqrt(most);
}

deformation_extremes assembly_extremes(const assembly *a, const double *x, bool with_stretch)
{
    deformation_extremes d = {.min_j = HUGE_VAL, .min_j_tet = -1, .max_stretch_tet = -1};
    for (int32_t t = 0; t < a->tet_count; t++) {
        double x_e[12], F[9], U[9], s[3], V[9];
        element_nodes(a->tet, t, x, x_e);
        element_gradient_F(a->el.gradient + 12 * (size_t)t, x_e, F);
        double J = mat_det(F);
        if (!(J > 0)) d.inverted_count++;
        if (J < d.min_j) {
            d.min_j = J;
            d.min_j_tet = t;
        }
        if (!with_stretch || stretch_bound(F) <= d.max_stretch) continue;
        svd3(F, U, s, V);
        if (s[0] > d.max_stretch) {
            d.max_stretch = s[0];
            d.max_stretch_tet = t;
        }
    }
    return d;
}
