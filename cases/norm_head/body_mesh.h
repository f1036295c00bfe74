/* body_mesh: the surface of a body of the norm head, meshed by the label mesher. */
#pragma once
#include "bodies.h"
#include "geometry/surface.h"

typedef enum body_id { BODY_SKIN, BODY_SKULL, BODY_MANDIBLE, BODY_COUNT } body_id;

double body_distance(const bodies *b, body_id id, const double p[3]);
/* Unit gradient of the distance, by differences. */
void body_normal(const bodies *b, body_id id, const double p[3], double n[3]);
/* The closed outward surface; edge lengths are `coarseness` (1: 1.6 mm at the lips, 4 mm at the back of the
 * head) times the standard ones. The caller frees *out. */
bool body_surface(const bodies *b, body_id id, double coarseness, surface *out, err *e) MUST_CHECK;
