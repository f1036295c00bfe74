/* shapes: bones known by a formula, for stress cases and tests. */
#pragma once
#include "sim/contact.h"

typedef enum known_kind {
    KNOWN_PLANE, /* all that is lower than at */
    KNOWN_PLATE, /* level, without end, at in its middle */
    KNOWN_BALL,  /* at in its middle */
    KNOWN_EDGE,  /* all that is lower than at and to the right of it */
    KNOWN_CUSPS, /* every 4 mm, a product of cosines; at on a tip */
    KNOWN_TEETH  /* pyramids every 4 mm; at on a tip */
} known_kind;

typedef struct known_bone {
    known_kind kind;
    double at[3]; /* mm */
    double size;  /* mm: radius of the ball, half the plate's thickness, height of cusps and teeth */
    double round; /* mm: creases of plate, edge and teeth are blended so near to them, else the distance is
                     exact there */
} known_bone;

/* Twice continuously differentiable, its zero the bone's surface, its gradient 1 long but over cusps (the
 * height over them) and at most 1 over teeth (the height by the slope's length). b is borrowed, as its
 * context. */
bone_shape known_shape(const known_bone *b);
