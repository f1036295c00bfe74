/* pictures_subject: an outcome made ready to be drawn. Needs GNATHOS_RENDER. */
#pragma once
#include "app/pictures/standard.h"
#include "geometry/cut_rims.h"
#include "render/gallery.h"

typedef struct pictures_subject { /* not to be moved in memory */
    subject shown;
    subject_part part[SEGMENT_COUNT];
    const segments *at_rest;
    cut_rims rims;
    bool rims_known;
    double *signed_mm, *stretch_percent; /* NULL until measured */
} pictures_subject;

/* Borrows what `in` points to. Free with pictures_subject_free. */
void pictures_subject_make(const pictures_input *in, pictures_subject *out);
void pictures_subject_free(pictures_subject *p); /* idempotent */
/* Works out what only some pictures need (SHOW_SIGNED, SHOW_STRETCH, the lines of the cuts for SHOW_BONES), once.
 * Refuses (ERR_USAGE) the signed distance in a build without CGAL. */
bool pictures_subject_measure(pictures_subject *p, panel_show show, err *e) MUST_CHECK;
