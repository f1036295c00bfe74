/* pictures: the standard pictures of an outcome. Needs GNATHOS_RENDER. */
#pragma once
#include "geometry/frame.h"
#include "geometry/segments.h"

typedef struct pictures_input {
    const char *case_name, *plan_text, *hash;
    const surface *skin_before, *skin_after;
    const segments *at_rest;
    const rigid *move;               /* [SEGMENT_COUNT] */
    const landmarks *before, *after; /* same labels and order */
    const head_frame *frame;
} pictures_input;

enum { PICTURES_WIDTH = 1920, PICTURES_HEIGHT = 1080 }; /* pixels where none are asked for */

/* The standard pictures as PNG files into `folder`, which must exist. */
bool pictures_write(const pictures_input *in, const char *folder, err *e) MUST_CHECK;
