/* head_jaw: the mandible of a head turned about its condyles with the tissue that hangs on it; an open mouth closed. */
#pragma once
#include "app/planner/identity/head_place.h"

/* Mandible and lower teeth go as a whole and take the tissue that is tied to them along; the rest of it, and the skin,
 * is in elastic equilibrium with that, the shape before being at rest. Facing nodes of the lips that come within 6 mm
 * of each other are brought together again. Refuses (ERR_NOT_CONVERGED) a solve that fails and one that turns a tet
 * inside out; *s is then as before. */
bool head_jaw_turn(const head_template *t, const rigid *motion, head_shape *s, err *e) MUST_CHECK;

typedef enum jaw_stop {
    JAW_NOT_OPEN, /* less than 2 mm: nothing was turned */
    JAW_AT_BITE,  /* the incisors overlap as the template's do */
    JAW_AT_TEETH, /* other teeth meet before */
    JAW_AT_LIMIT  /* a hinge does not turn farther: the condyles must have glided forwards */
} jaw_stop;

typedef struct head_closing {
    jaw_stop stop;
    double open_mm;  /* the incisors' edges, upwards, from where they would overlap as the template's do */
    double turn_deg; /* up, about the axis through both condylia */
    double left_mm;  /* of open_mm afterwards */
} head_closing;

/* Turns the mandible up until the incisors overlap as the template's do where it was placed, or teeth meet, or the
 * joint's limit is reached. Refuses what head_teeth_overlap and head_jaw_turn refuse. */
bool head_jaw_close(const head_template *t, const head_place *place, const task *watch, head_shape *s,
                    head_closing *out, err *e) MUST_CHECK;
/* "closed by 4.2 deg until teeth meet; 1.1 mm of 6.0 mm stay open", or the like. */
const char *head_closing_text(const head_closing *c, char *text, size_t size);
