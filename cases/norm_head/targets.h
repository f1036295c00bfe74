/* targets: where the landmarks of the mean head go so that the measures come out as asked. */
#pragma once
#include "norm_head.h"
#include "places.h"

/* to[3*count]: the wanted position of every place; held[count]: true where the measures (or symmetry) decide
 * it, false where the warp is free. lower_molars_mm: how far the lower teeth behind the incisors stand below
 * where they would meet the upper ones of the mean head. */
void targets_find(const place *places, int count, const norm_head_params *p, const double value[MEASURE_COUNT],
                  double lower_molars_mm, double *to, bool *held);
/* Size of the sex against the mean (female) head, along x, y, z. */
void targets_scale(norm_sex sex, double scale[3]);
