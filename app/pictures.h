/* pictures: the standard before and after pictures of an outcome. Needs GNATHOS_RENDER. */
#pragma once
#include "geometry/frame.h"
#include "geometry/segments.h"

typedef struct pictures_input {
    const char *case_name, *plan_text, *hash;
    const surface *skin_before, *skin_after;
    const segments *at_rest;
    const rigid *move; /* [SEGMENT_COUNT] */
    const landmarks *points;
    const head_frame *frame;
    int width, height;  /* of one half of a comparison, pixels; 0: the usual */
    double skin_opacity; /* over the bones; 0: the usual */
    double heat_high_mm; /* end of the displacement scale; 0: from the data */
} pictures_input;

/* Writes PNG files into `folder`, which must exist; names go to stdout if `list`. */
bool pictures_write(const pictures_input *in, const char *folder, bool list, err *e) MUST_CHECK;
