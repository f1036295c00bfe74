/* bodies: the parts of the mean head as signed distances (mm), in the Frankfort frame of the template: origin
 * between the porions, +x left, +y posterior, +z up. Symmetric in x. Built once, then queried from any
 * thread. */
#pragma once
#include "radial.h"
#include "tube.h"
#include <stdbool.h>

enum { SKIN_TUBES = 16, SKULL_TUBES = 20, MANDIBLE_TUBES = 10 };

typedef struct bodies {
    radial face;  /* head without nose, lips, ears, neck */
    radial vault; /* braincase */
    tube skin[SKIN_TUBES], skull[SKULL_TUBES], mandible[MANDIBLE_TUBES];
} bodies;

bodies bodies_build(void);
void bodies_free(bodies *b);

double body_skin(const bodies *b, const double p[3]);
bool body_skin_fold(const double p[3]);                   /* in a nostril */
double skin_lid_line(double x);                           /* height of the line between the lids */
double skin_lip_line(double x);                           /* between the lips: the tissue is parted there */
double skin_lip_top(double x);                            /* upper border of the vermilion */
double skin_lip_bottom(double x);                         /* and the lower one */
double body_skull(const bodies *b, const double p[3]);    /* no teeth, no mandible */
double body_mandible(const bodies *b, const double p[3]); /* no teeth */

/* Used by bodies_build. */
radial body_skin_base(void);
radial body_skull_vault(void);
void body_skin_tubes(tube *t);
void body_skin_lids(bodies *b); /* after the others */
void body_skull_tubes(tube *t);
void body_mandible_tubes(tube *t);
