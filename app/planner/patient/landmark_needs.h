/* landmark_needs: which landmarks are known, on which surface they lie, and what is lost without them. */
#pragma once
#include "app/planner/patient/case_file.h"

enum {                     /* bits */
       NEED_OPTIONAL = 0,  /* something is lost */
       NEED_ALWAYS = 1,    /* no frame or no tissue without it */
       NEED_LE_FORT_1 = 2, /* for the cut, if the case has it */
       NEED_BSSO = 4,
       NEED_GENIOPLASTY = 8
};

typedef struct landmark_row {
    const char *label;
    unsigned need;
    const char *instead; /* labels that together do as well, or alternatives, split by " or "; NULL: none */
    case_surface on;     /* the surface it lies on; CASE_SURFACE_COUNT: inside the head */
    const char *help;    /* what it is */
    const char *lost;    /* what is lost without it; NULL for required ones */
} landmark_row;

extern const landmark_row landmark_rows[];
extern const int landmark_row_count;
const landmark_row *landmark_row_find(const char *label); /* NULL: a label of the user's own */

bool landmark_is_needed(const landmark_row *row, const case_file *c);
