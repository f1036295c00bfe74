/* plan_attach: how the tissue along the saw cuts hangs on the bones in one plan.
 *
 * A prepared tissue is loose along every cut of the case, on both sides alike. Which cuts part is known with
 * the plan only: along one whose sides move together nothing was cut, and the tissue is tied as elsewhere.
 * Along one that opens, the piece that is moved carries its tissue up to the edge: it keeps its soft pedicle
 * (Peterson's Principles of Oral and Maxillofacial Surgery 2022, chapters 62 and 63), and pushes what lies in
 * front of it. The bone that stays was bared to reach the cut: tissue there hangs loose over a strip. */
#pragma once
#include "geometry/rest_gap.h"
#include "geometry/rigid.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct plan_attach_params {
    double cut_mm;   /* a loose bone node nearer than this to the saw is loose because of it */
    double bared_mm; /* width of the strip on the bone that stays */
    double edge_mm;  /* the last strip on the piece that moves, loose as well */
} plan_attach_params;

plan_attach_params plan_attach_params_default(double cut_band_mm);

typedef struct plan_attach_report {
    int32_t tied, loosened; /* nodes */
} plan_attach_report;

/* A new map for this plan; the caller frees *out. gap: of t. */
void plan_attach(const tissue *t, const rest_gap *gap, const rigid motion[SEGMENT_COUNT], const plan_attach_params *p,
                 attach_map *out, plan_attach_report *report);

#ifdef __cplusplus
}
#endif
