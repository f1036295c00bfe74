/* shape: the materials that measure the distance to a target shape. */
#pragma once
#include "sim/material.h"

/* P[9] may be NULL. */
double shape_energy(const material *m, const double F[9], double P[9]);
/* Where two singular values of F A cancel, R is not unique and the energy has a crease: their sum is kept
 * above 1e-6 there. */
void shape_hessian(const material *m, const double F[9], projection how, double H[81]);
