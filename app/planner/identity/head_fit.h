/* head_fit: the template on a patient. First as a whole (head_place), then bent: least elastic energy of the template
 * under point constraints at the patient's surfaces, stiffer from stage to stage with targets found anew in each; parts
 * of the scan that are open or missing carry no target. Bones bend on their own, teeth turn, shift and grow one by one;
 * the tissue follows: to the shape at rest, then to the neutral one. Specification 1.2; Amberg and others 2007 for the
 * stages. */
#pragma once
#include "app/planner/identity/head_place.h"
#include "sim/registration.h"

typedef struct head_fit_params {
    bool use_landmarks;     /* for the place; they never pull on the bent template */
    const head_shape *from; /* what is bent, in the patient's frame; NULL: the template as it was placed */
} head_fit_params;
head_fit_params head_fit_params_default(void);

/* Why a vertex is not where the scan has a surface. */
typedef enum head_guess {
    GUESS_NONE,   /* it is */
    GUESS_ABSENT, /* the scan has none there: the place is the template's, bent along */
    GUESS_CLOSED, /* the scan has it in another place: it went with a mouth that was closed (head_complete) */
    GUESS_MISSED  /* the scan has a surface across from it, but 5 to 15 mm off: the fit did not reach it */
} head_guess;

extern const double fit_found_mm, fit_missed_mm; /* 5 and 15 */

typedef struct head_fit {
    head_place place;
    head_shape shape;                   /* in the patient's frame */
    double *gap_mm[CASE_SURFACE_COUNT]; /* [vertex_count] to the patient's surface, up to 15; NAN: it has none there */
    uint8_t *guessed[CASE_SURFACE_COUNT];       /* [vertex_count] head_guess */
    registration_gaps gaps[CASE_SURFACE_COUNT]; /* from the template's vertices to the patient's surface, up to 5 mm */
    registration_gaps back[CASE_SURFACE_COUNT]; /* from the patient's, where they lie outside and within 15 mm of it */
    double *back_mm[CASE_SURFACE_COUNT];        /* [vertices of the scan] NAN: others. NULL: no scan, or of a file */
    double back_missed[CASE_SURFACE_COUNT];     /* share of these that are farther than 5 mm */
    double min_j;                               /* of the tissue against the template, rest and neutral */
    int32_t inverted_tets;
    int iterations, factorisations;
    double place_s, bones_s, tissue_s, total_s; /* wall */
} head_fit;

/* Refuses what head_place_find refuses, and (ERR_NOT_CONVERGED) a fit with an inverted tet or a stage whose solve
 * fails. The caller frees *out. */
bool head_fit_make(const head_template *t, const head_scan *s, const head_fit_params *p, const task *watch,
                   head_fit *out, err *e) MUST_CHECK;
/* The same from a place that is known. */
bool head_fit_from(const head_template *t, const head_scan *s, const head_fit_params *p, const head_place *place,
                   const task *watch, head_fit *out, err *e) MUST_CHECK;
/* The surfaces of a scan are the template's, vertex by vertex: so are those of heads that gnathos makes as coarse. */
bool head_fit_is_numbered(const head_template *t, const head_scan *s);
/* The fit of such a scan: its vertices are known and nothing is sought but the tissue between them. No gaps. Refuses
 * (ERR_INPUT) other scans, and what head_fit_make refuses of the tissue. */
bool head_fit_numbered(const head_template *t, const head_scan *s, const task *watch, head_fit *out, err *e) MUST_CHECK;
/* min_j and inverted_tets of the shape as it is, the place's size taken out. */
void head_fit_measure_tets(const head_template *t, head_fit *f);
/* What a picture shows of a vertex: its gap, NAN where it is absent or closed. */
double fit_shown_mm(const head_fit *f, case_surface part, size_t vertex);
void head_fit_free(head_fit *f);
