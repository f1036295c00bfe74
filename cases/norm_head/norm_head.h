/* norm_head: a synthetic patient from published norms: bones, teeth and skin that nobody ever had.
 *
 * One mean head is made of signed-distance shapes and meshed; smooth warps then take its landmarks exactly to
 * where the asked measures want them. Axes LPS, origin between the porions, Frankfort plane z = 0. Symmetric
 * unless asked. */
#pragma once
#include "geometry/landmarks.h"
#include "geometry/surface.h"
#include "norms.h"

typedef struct norm_head_params {
    norm_sex sex;
    uint64_t seed;      /* 0: the mean head of the sex */
    int skeletal_class; /* 1, 2, 3 */
    double open_bite_mm;
    double asymmetry_mm; /* of the chin, to the left */
    double coarseness;   /* of the meshes, 1 to 3 */
    bool is_set[MEASURE_COUNT];
    double set[MEASURE_COUNT];
} norm_head_params;

typedef struct norm_head {
    surface skin, skull, mandible, upper_teeth, lower_teeth; /* closed, outward; skin coloured; teeth one shell each */
    landmarks points;
    double asked[MEASURE_COUNT], obtained[MEASURE_COUNT];
    double thinnest_mm; /* smallest distance from skin to bone or tooth */
} norm_head;

norm_head_params norm_head_params_default(void);
/* Refuses (ERR_USAGE) a class other than 1..3 and a measure outside its range. */
bool norm_head_params_check(const norm_head_params *p, err *e) MUST_CHECK;
/* The caller frees *out. Refuses what norm_head_params_check does. About half a minute on two cores. */
bool norm_head_build(const norm_head_params *p, norm_head *out, err *e) MUST_CHECK;
void norm_head_free(norm_head *h);

/* The same in two steps, for many heads: the mean head's meshes once, then each head from them. */
typedef struct norm_mean norm_mean;
/* mandible_alone: what a split needs. Without the meshes of skin and skull: its heads have neither, no points on the
 * skin and no measures of soft tissue; points on the skull lie where it would be, to 0.1 mm. The caller frees *out with
 * norm_mean_free. */
bool norm_mean_build(double coarseness, bool mandible_alone, norm_mean **out, err *e) MUST_CHECK;
/* p->coarseness is ignored: that of the mean head holds. The caller frees *out. */
bool norm_head_shape(const norm_mean *m, const norm_head_params *p, norm_head *out, err *e) MUST_CHECK;
void norm_mean_free(norm_mean *m);
