/* places: the landmarks of the mean head, on its bodies and teeth. */
#pragma once
#include "body_mesh.h"
#include "geometry/landmarks.h"

typedef enum place_on { ON_SKIN, ON_SKULL, ON_MANDIBLE, ON_UPPER_TEETH, ON_LOWER_TEETH } place_on;

typedef struct place {
    char label[LANDMARK_LABEL_SIZE];
    place_on on;     /* which surface carries it (or, for points inside, moves it) */
    bool on_surface; /* false: S, the apices, the edge between the incisors */
    double xyz[3];
} place;

/* Onto the body along its normals, from nearby; in the midline if asked. */
void place_project(const bodies *b, body_id id, bool midline, double p[3]);
/* All of them, found on the bodies. The caller frees *out. */
int places_find(const bodies *b, place **out);
