/* norms: the measures of a head, their published means and spreads, and how each is measured on landmarks.
 * Angles in degrees, lengths in mm; heights and depths along and across the Frankfort plane. */
#pragma once
#include "geometry/landmarks.h"
#include <stdint.h>

typedef enum norm_sex { NORM_FEMALE, NORM_MALE } norm_sex;

typedef enum measure_id {
    SN_MM,
    SN_FH_DEG,
    SNA_DEG,
    SNB_DEG,
    N_ANS_MM,
    LOWER_FACE_MM,
    ANS_PNS_MM,
    PALATE_SN_DEG,
    FMA_DEG,
    GO_POG_MM,
    CHIN_MM,
    U1_FH_DEG,
    U1_PALATE_MM,
    U6_PALATE_MM,
    IMPA_DEG,
    OVERJET_MM,
    OVERBITE_MM,
    BIZYGOMATIC_MM,
    BIGONIAL_MM,
    PIRIFORM_MM,
    INTERCANINE_MM,
    INTERMOLAR_MM,
    NASION_SOFT_MM,
    SUBNASALE_SOFT_MM,
    UPPER_LIP_SOFT_MM,
    LOWER_LIP_SOFT_MM,
    SUPRAMENTAL_SOFT_MM,
    POGONION_SOFT_MM,
    MENTON_SOFT_MM,
    NOSE_MM,
    UPPER_LIP_MM,
    MOUTH_MM,
    NASAL_WIDTH_MM,
    /* depths of the soft tissue, measured on the meshes (thickness.h) */
    GLABELLA_SOFT_MM,
    MID_NASAL_SOFT_MM,
    RHINION_SOFT_MM,
    MID_PHILTRUM_SOFT_MM,
    MID_SUPRAORBITAL_SOFT_MM,
    MID_INFRAORBITAL_SOFT_MM,
    ALAR_CURVATURE_SOFT_MM,
    ZYGION_SOFT_MM,
    SUPRA_CANINE_SOFT_MM,
    INFRA_CANINE_SOFT_MM,
    SUPRA_M2_SOFT_MM,
    INFRA_M2_SOFT_MM,
    MID_RAMUS_SOFT_MM,
    GONION_SOFT_MM,
    MID_BORDER_SOFT_MM,
    MEASURE_COUNT
} measure_id;

typedef struct measure {
    const char *name, *help, *source;
    double mean[2], sd[2]; /* [norm_sex] */
    double class_shift[2]; /* added for class II and class III */
    double low, high;      /* what the generator can build */
} measure;

extern const measure measures[MEASURE_COUNT];

int measure_find(const char *name); /* -1 if there is none */
/* Of the landmarks, for those before GLABELLA_SOFT_MM; asserts that those it needs are there. Frankfort plane: z = 0 of
 * the generator's axes. */
double measure_of(measure_id id, const landmarks *l);

/* Means of the sex, shifted to the skeletal class 1, 2 or 3, plus one draw of each spread (within two
 * standard deviations) unless seed is 0. The same seed gives the same head on every machine. */
void norms_draw(norm_sex sex, int skeletal_class, uint64_t seed, double value[MEASURE_COUNT]);
