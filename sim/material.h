/* material: isotropic elastic energies of one deformation gradient.
 *
 * The first models are functions psi(I, J) of I = |F|^2 and J = det F, given as value and first and second
 * derivatives; stress, stiffness and its eigenvectors follow from those alone. A new one is one more case
 * in material_terms_at. The others measure the distance to a target shape A, rotated as suits F best:
 *   psi = mu min_R |F - R A|^2 + lambda/2 (J - det A)^2
 * with the A of material_set_target, at first the identity. F, P are row-major 3x3; a 9x9 Hessian is
 * row-major over the same order. Stress in kPa, energy density in kPa (= uJ/mm^3), zero at F = I (F = A) and
 * at every rotation of it. */
#pragma once
#include "geometry/err.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef enum material_model {
    MATERIAL_SNH_LOG,         /* Stable Neo-Hookean with the logarithm: Smith, de Goes, Kim 2018, eq. 14; default */
    MATERIAL_SNH,             /* the same without the logarithm */
    MATERIAL_NH_LN,           /* mu/2 (I-3) - mu ln J + lambda/2 (ln J)^2; infinite for J <= 0 */
    MATERIAL_NH_ISO,          /* mu/2 (J^(-2/3) I - 3) + K/2 (J-1)^2; infinite for J <= 0 */
    MATERIAL_FIXED_COROTATED, /* Stomakhin et al. 2012; Lame's mu and lambda */
    MATERIAL_ARAP,            /* the same without a volume term: poisson must be 0 */
    MATERIAL_MODEL_COUNT,
    MATERIAL_IJ_COUNT = MATERIAL_FIXED_COROTATED /* so many are functions of I and J */
} material_model;

/* mu and lambda are the constants of the model's own formula, not always those of Lame: for the logarithmic
 * form mu = 4/3 mu_L, lambda = lambda_L + 5/6 mu_L (section 3.4 there), so that small strains obey young_kpa,
 * poisson. */
typedef struct material {
    material_model model;
    double young_kpa, poisson;
    double mu_kpa, lambda_kpa;
    double averaged_kpa;        /* part of lambda_kpa that elements average (element_choose); material_make: 0 */
    double pressure_kpa;        /* adds pressure_kpa (J - 1) to snhlog and snh; material_make: 0 */
    double target[9], target_j; /* A and its determinant */
} material;

typedef struct material_terms {
    double psi;          /* HUGE_VAL where the model has no energy (the rest is then zero) */
    double psi_i, psi_j; /* d psi / d I, d psi / d J */
    double psi_ii, psi_ij, psi_jj;
} material_terms;

/* Refuses (ERR_INPUT) young_kpa <= 0, poisson outside the open range (-1, 0.5), and for MATERIAL_ARAP any but
 * 0. */
bool material_make(material_model model, double young_kpa, double poisson, material *out, err *e) MUST_CHECK;
/* Shape targeting (Klar, Moffat, Museth, Sifakis 2020): tissue that wants to have the shape A. Refuses
 * (ERR_INPUT) a model of I and J and an A that is not symmetric positive definite. */
bool material_set_target(material *m, const double A[9], err *e) MUST_CHECK;
/* "snhlog", "snh", "nhln", "nhiso", "fcr", "arap" */
const char *material_model_name(material_model model);
/* Model for a name, -1 if there is none. */
int material_model_from_name(const char *name);

/* Of a model of I and J. */
material_terms material_terms_at(const material *m, const double F[9]);
/* dJ/dF */
void material_cofactor(const double F[9], double out[9]);
double material_energy(const material *m, const double F[9]);
void material_stress(const material *m, const double F[9], double P[9]);
void material_hessian(const material *m, const double F[9], double H[81]);

/* What is done about negative eigenvalues of the Hessian. */
typedef enum projection {
    PROJECTION_NONE,
    PROJECTION_CLAMP /* to zero */,
    PROJECTION_ABS /* to |.| */
} projection;
void material_hessian_projected(const material *m, const double F[9], projection how, double H[81]);
/* The negative eigenvalues and their unit eigenvectors (row-major 3x3), from the analytic eigensystem
 * (section 4.6 there, for any psi(I, J)). Returns how many. */
int material_negative_modes(const material_terms *t, const double F[9], double value[9], double mode[9][9]);

/* Which material a tissue region has. */
enum { REGION_ANY = INT32_MIN }; /* an entry for every region that no other entry names */
typedef struct region_material {
    int32_t region;
    struct material material;
} region_material;

#ifdef __cplusplus
}
#endif
