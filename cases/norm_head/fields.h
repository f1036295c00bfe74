/* fields: the warps that take the mean head to the asked measures. */
#pragma once
#include "norm_head.h"
#include "thickness.h"

typedef struct fields { /* the pairs of the three warps */
    warp_pairs skin, upper, lower;
    warp up, down; /* through the last two */
} fields;

/* Number of the label in the list; -1 if there is none. */
int place_number(const place *list, int count, const char *label);
/* lower_molars_mm: how far the lower side teeth are lowered. The caller frees. */
fields fields_make(const norm_head_params *p, const place *list, int count, const thickness_site *sites,
                   const double *asked, double lower_molars_mm);
void fields_free(fields *f);
