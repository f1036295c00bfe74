/* tissue_domain: where the soft tissue is, as a label function. Private to geometry. */
#pragma once
#include "geometry/sdf_grid.h"
#include "geometry/tissue.h"

enum { MAX_ATTRACTORS = 16 };

typedef struct tissue_domain {
    const tissue_params *params;
    head_frame frame;
    sdf_grid skin, wrap, span;  /* skin; wrap tight around the bones; wide wrap that spans the skeleton's holes */
    double coronal, neck, brow; /* cut planes in the head frame, mm */
    lip_sheet lips;
    double attract[MAX_ATTRACTORS][2][3]; /* segments along which elements are finest */
    int attractors;
    double low[3], high[3]; /* box of the domain, LPS mm */
} tissue_domain;

bool tissue_domain_make(const tissue_input *in, const tissue_params *p, tissue_domain *out, err *e) MUST_CHECK;
void tissue_domain_free(tissue_domain *d);
int tissue_domain_label(const double p[3], void *domain);
double tissue_domain_size(const double p[3], int region, void *domain);
node_side tissue_domain_side(const tissue_domain *d, const double p[3]);
